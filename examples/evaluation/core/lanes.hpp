// Structs of floats and of packs: the lanes of one from the other, and runs over groups of receivers.
#pragma once

#include "timed_look_ups.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace gnomon::evaluation {

template <class Real> inline constexpr std::size_t lanes_of = 1;
template <> inline constexpr std::size_t lanes_of<receiver_pack> = receiver_pack::size;

// The number of members of a struct of floats.
template <template <class...> class Struct>
inline constexpr std::size_t member_count = sizeof(std::array<Struct<float>, 1>) / sizeof(float);

// A struct of packs whose lane i is the struct of floats fetch(i).
template <template <class...> class Struct, class Real> Struct<Real> gathered(auto&& fetch)
{
    if constexpr (std::is_same_v<Real, float>) return fetch(std::size_t(0));
    else {
        constexpr std::size_t count = member_count<Struct>;
        alignas(Real) std::array<std::array<float, Real::size>, count> lanes;
        for (std::size_t i = 0; i < Real::size; ++i) {
            const auto one = std::bit_cast<std::array<float, count>>(fetch(i));
            for (std::size_t k = 0; k < count; ++k) lanes[k][i] = one[k];
        }
        return std::bit_cast<Struct<Real>>(lanes);
    }
}

// The lanes of a struct of packs.
template <template <class...> class Struct, class Real> class scattered {
  public:
    explicit scattered(const Struct<Real>& all) : lanes_(std::bit_cast<decltype(lanes_)>(all)) {}

    Struct<float> operator[](std::size_t lane) const
    {
        std::array<float, count> one;
        for (std::size_t k = 0; k < count; ++k) one[k] = lanes_[k][lane];
        return std::bit_cast<Struct<float>>(one);
    }

  private:
    static constexpr std::size_t count = member_count<Struct>;
    std::array<std::array<float, lanes_of<Real>>, count> lanes_;
};

// One group of receivers at a time, whatever the compiler could do with the loop.
template <class Real> void run_groups(std::size_t groups, std::span<float> result, const auto& shadow_of)
{
    for (std::size_t i = 0; i < groups; ++i) {
        const Real found = shadow_of(i);
        if constexpr (std::is_same_v<Real, float>) result[i] = found;
        else found.store_unaligned(&result[i * lanes_of<Real>]);
        asm volatile("" ::: "memory");
    }
}

// Runs to time of one receiver after the other, and of packs of them. fetch.operator()<Real>(group) returns Values<Real> of a
// group of receivers, and kernel(values) the shadow. Both outlive what is returned.
template <template <class> class Values, class Fetch, class Kernel>
std::vector<timed_look_up> timed_fetches(std::size_t receivers, Fetch fetch, Kernel kernel)
{
    const auto of = [=]<class Real>() {
        return detail::timed_groups<Values<Real>, Real>(
            receivers, int(lanes_of<Real>), [=](std::size_t group) { return fetch.template operator()<Real>(group); },
            kernel);
    };
    return {of.template operator()<float>(), of.template operator()<receiver_pack>()};
}

// The same where the kernel is the look-up: shadow_of.operator()<Real>(group) of a group of receivers.
template <class Shadow> std::vector<timed_look_up> timed_whole(std::size_t receivers, Shadow shadow_of)
{
    const auto of = [=]<class Real>() {
        const std::size_t groups = receivers / lanes_of<Real>;
        const timed_run all{groups * lanes_of<Real>, [=](std::span<float> result) {
                                run_groups<Real>(groups, result, [&](std::size_t group) {
                                    return shadow_of.template operator()<Real>(group);
                                });
                            }};
        return timed_look_up{int(lanes_of<Real>), all, all};
    };
    return {of.template operator()<float>(), of.template operator()<receiver_pack>()};
}

} // namespace gnomon::evaluation
