// Times of work on one core.
#pragma once

#include <tbb/global_control.h>
#include <time.h>

#include <algorithm>

namespace gnomon::evaluation {

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

// The time of work whose parallel parts run on this thread.
double seconds_on_one_core(auto&& run)
{
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    return seconds(run);
}

// The least of several times that measure() returns: the first run finds memory cold, and what is short is the more
// disturbed by others. What takes long runs once.
double least_of(auto&& measure)
{
    constexpr double enough = 0.03, is_long = 0.15;
    double spent = measure(), least = spent;
    if (spent > is_long) return least;
    do {
        const double again = measure();
        spent += again, least = std::min(least, again);
    } while (spent < enough);
    return least;
}

// Of runs on one core.
double least_seconds(auto&& run)
{
    return least_of([&] { return seconds_on_one_core(run); });
}

} // namespace gnomon::evaluation
