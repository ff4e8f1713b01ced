// Runs to time of a map whose texels hold a struct of numbers: one receiver after the other, and by packs of receivers;
// and their times.
#pragma once

#include "method.hpp"
#include "timing.hpp"

#include <gnomon/simd/xsimd.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

struct measured_time {
    int lanes;
    double ns_kernel, ns_per_receiver;
};

// Nanoseconds per receiver: the least time of at least three runs, and of as many as fit into so many seconds.
inline double nanoseconds(const timed_run& timed, std::span<float> result, double spent_at_least = 0.15)
{
    double least = std::numeric_limits<double>::infinity(), spent = 0;
    for (int i = 0; i < 3 || spent < spent_at_least; ++i) {
        const double time = seconds([&] { timed.run(result); });
        least = std::min(least, time);
        spent += time;
    }
    return 1e9 * least / double(std::max<std::size_t>(timed.receivers, 1));
}

using receiver_pack = gnomon::pack<xsimd::batch<float>>;

namespace detail {

template <class Channels, class Real> struct fetched {
    Channels channels;
    Real depth;
};

// fetch(i) returns the values of group i of receivers.
template <class Channels, class Real, class Fetch, class Kernel>
timed_look_up timed_groups(std::size_t receivers, int lanes, Fetch fetch, Kernel kernel)
{
    const std::size_t groups = receivers / std::size_t(lanes);
    std::vector<fetched<Channels, Real>> values(groups);
    tbb::parallel_for(std::size_t(0), groups, [&](std::size_t i) { values[i] = fetch(i); });
    const auto run = [=](const auto& value_of, std::span<float> result) {
        for (std::size_t i = 0; i < groups; ++i) {
            const fetched<Channels, Real>& f = value_of(i);
            const Real found = kernel(f.channels, f.depth);
            if constexpr (std::is_same_v<Real, float>) result[i] = found;
            else found.store_unaligned(&result[i * std::size_t(lanes)]);
            asm volatile("" ::: "memory"); // one at a time, whatever the compiler could do with some methods' loops
        }
    };
    const std::size_t covered = groups * std::size_t(lanes);
    return {lanes,
            {covered,
             [=, values = std::move(values)](std::span<float> result) {
                 run([&](std::size_t i) -> const fetched<Channels, Real>& { return values[i]; }, result);
             }},
            {covered, [=](std::span<float> result) { run(fetch, result); }}};
}

} // namespace detail

// fetch(receiver) returns channels as Channels<float>, and kernel(channels, depth) their shadow, of floats and of packs.
// Receivers that are left over by packs are not timed. The receivers outlive what is returned.
template <template <class> class Channels, class Fetch, class Kernel>
std::vector<timed_look_up> timed_look_ups(std::span<const map_receiver> where, Fetch fetch, Kernel kernel)
{
    using pack = receiver_pack;
    using one = detail::fetched<Channels<float>, float>;
    using several = detail::fetched<Channels<pack>, pack>;
    constexpr std::size_t count = sizeof(Channels<float>) / sizeof(float);
    const auto by_packs = [=](std::size_t group) {
        alignas(pack) std::array<std::array<float, pack::size>, count> lanes;
        alignas(pack) std::array<float, pack::size> depths;
        for (std::size_t lane = 0; lane < pack::size; ++lane) {
            const map_receiver& r = where[group * pack::size + lane];
            const auto numbers = std::bit_cast<std::array<float, count>>(fetch(r));
            for (std::size_t k = 0; k < count; ++k) lanes[k][lane] = numbers[k];
            depths[lane] = r.depth;
        }
        return several{std::bit_cast<Channels<pack>>(lanes), pack::load_aligned(depths.data())};
    };
    return {detail::timed_groups<Channels<float>, float>(
                where.size(), 1,
                [=](std::size_t i) {
                    return one{fetch(where[i]), where[i].depth};
                },
                kernel),
            detail::timed_groups<Channels<pack>, pack>(where.size(), int(pack::size), by_packs, kernel)};
}

} // namespace gnomon::evaluation
