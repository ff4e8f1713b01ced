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
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

struct measured_time {
    int lanes;
    double ns_kernel, ns_per_receiver;
};

// Receivers to time: 16 runs of neighbours from all over the picture.
template <std::ranges::random_access_range Receivers>
std::vector<std::ranges::range_value_t<Receivers>> runs_to_time(const Receivers& where, std::size_t neighbours = 512)
{
    constexpr std::size_t runs = 16;
    if (where.size() <= runs * neighbours) return {where.begin(), where.end()};
    std::vector<std::ranges::range_value_t<Receivers>> result;
    for (std::size_t i = 0; i < runs; ++i) {
        const auto first = where.begin() + std::ptrdiff_t((2 * i + 1) * (where.size() - neighbours) / (2 * runs));
        result.insert(result.end(), first, first + std::ptrdiff_t(neighbours));
    }
    return result;
}

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

// fetch(i) returns the values of group i of receivers.
template <class Values, class Real, class Fetch, class Kernel>
timed_look_up timed_groups(std::size_t receivers, int lanes, Fetch fetch, Kernel kernel)
{
    const std::size_t groups = receivers / std::size_t(lanes);
    std::vector<Values> values(groups);
    tbb::parallel_for(std::size_t(0), groups, [&](std::size_t i) { values[i] = fetch(i); });
    const auto run = [=](const auto& value_of, std::span<float> result) {
        for (std::size_t i = 0; i < groups; ++i) {
            const Real found = kernel(value_of(i));
            if constexpr (std::is_same_v<Real, float>) result[i] = found;
            else found.store_unaligned(&result[i * std::size_t(lanes)]);
            asm volatile("" ::: "memory"); // one at a time, whatever the compiler could do with some methods' loops
        }
    };
    const std::size_t covered = groups * std::size_t(lanes);
    return {lanes,
            {covered,
             [=, values = std::move(values)](std::span<float> result) {
                 run([&](std::size_t i) -> const Values& { return values[i]; }, result);
             }},
            {covered, [=](std::span<float> result) { run(fetch, result); }}};
}

template <template <class> class Channels> struct channels_at_depth {
    template <class Real> struct values {
        Channels<Real> channels;
        Real depth;
    };
};

} // namespace detail

// fetch(receiver) returns Values<float>, a struct of floats, and kernel(values) the shadow, of floats and of packs. Receivers
// that are left over by packs are not timed. The receivers outlive what is returned.
template <template <class> class Values, class Receiver, class Fetch, class Kernel>
std::vector<timed_look_up> timed_values(std::span<const Receiver> where, Fetch fetch, Kernel kernel)
{
    using pack = receiver_pack;
    constexpr std::size_t count = sizeof(Values<float>) / sizeof(float);
    const auto by_packs = [=](std::size_t group) {
        alignas(pack) std::array<std::array<float, pack::size>, count> lanes;
        for (std::size_t lane = 0; lane < pack::size; ++lane) {
            const auto numbers = std::bit_cast<std::array<float, count>>(fetch(where[group * pack::size + lane]));
            for (std::size_t k = 0; k < count; ++k) lanes[k][lane] = numbers[k];
        }
        return std::bit_cast<Values<pack>>(lanes);
    };
    return {detail::timed_groups<Values<float>, float>(
                where.size(), 1, [=](std::size_t i) { return fetch(where[i]); }, kernel),
            detail::timed_groups<Values<pack>, pack>(where.size(), int(pack::size), by_packs, kernel)};
}

// fetch(receiver) returns channels as Channels<float>, and kernel(channels, depth) their shadow at the receiver's depth.
template <template <class> class Channels, class Fetch, class Kernel>
std::vector<timed_look_up> timed_look_ups(std::span<const map_receiver> where, Fetch fetch, Kernel kernel)
{
    using values = typename detail::channels_at_depth<Channels>::template values<float>;
    return timed_values<detail::channels_at_depth<Channels>::template values>(
        where,
        [=](const map_receiver& r) {
            return values{fetch(r), r.depth};
        },
        [=](const auto& v) { return kernel(v.channels, v.depth); });
}

} // namespace gnomon::evaluation
