// Receivers of soft shadows as floats and as packs: structs of packs from those of floats and back, and runs over groups.
#pragma once

#include "evaluation/core/timed_look_ups.hpp"
#include "soft_method.hpp"

#include <array>
#include <bit>
#include <type_traits>

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

// Group i of receivers.
template <class Real> soft_place<Real> place_of(std::span<const soft_receiver> where, std::size_t group)
{
    return gathered<soft_place, Real>([&](std::size_t lane) { return where[group * lanes_of<Real> + lane]; });
}

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

} // namespace gnomon::evaluation
