// View rays as floats and as packs.
#pragma once

#include "evaluation/core/lanes.hpp"
#include "scattering_method.hpp"

namespace gnomon::evaluation {

// View segments, member by member.
template <class Real> struct view_rays {
    Real x, y, z, footprint, column, row; // the end, the footprint and the pixel
};

// Group i of view rays.
template <class Real> view_rays<Real> rays_of(std::span<const view_segment> where, std::size_t group)
{
    return gathered<view_rays, Real>([&](std::size_t lane) {
        const view_segment& s = where[group * lanes_of<Real> + lane];
        return view_rays<float>{s.end.x, s.end.y, s.end.z, s.footprint, s.pixel.x, s.pixel.y};
    });
}

// The visibilities of rays whose shadow intensity is intensity.operator()<Real>(group), by packs as far as they go.
void visibilities_by_packs(std::size_t rays, std::span<float> result, const auto& intensity)
{
    constexpr std::size_t lanes = lanes_of<receiver_pack>;
    const std::size_t packed = rays / lanes;
    for (std::size_t i = 0; i < packed; ++i)
        (receiver_pack(1.0f) - intensity.template operator()<receiver_pack>(i)).store_unaligned(&result[i * lanes]);
    for (std::size_t i = packed * lanes; i < rays; ++i) result[i] = 1 - intensity.template operator()<float>(i);
}

} // namespace gnomon::evaluation
