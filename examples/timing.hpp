// How long something takes on one core.
#pragma once

#include <tbb/global_control.h>
#include <time.h>

namespace gnomon::demo {

// Of this thread, whatever else the machine does.
inline double cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double seconds(auto&& run)
{
    const double start = cpu_seconds();
    run();
    return cpu_seconds() - start;
}

// The same, with whatever runs in parallel on this thread.
double seconds_on_one_core(auto&& run)
{
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    return seconds(run);
}

} // namespace gnomon::demo
