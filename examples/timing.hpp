// How long something takes on one core.
#pragma once

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

} // namespace gnomon::demo
