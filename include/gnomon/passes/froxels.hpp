// A grid of froxels over a whole view frustum (comparators/froxels.h): shadow intensities of froxels become those of all
// that a ray meets up to the froxel's end, and a look-up interpolates these.
//
//     for (k, y, x)   grid.slice(k)(x, y) = the shadow intensity somewhere between the ends of slices k - 1 and k
//     integrate_froxels(grid, slices, extinction, {0, grid.height});
//     intensity = froxel_intensity(grid, x, y, froxel_slice_of(distance, slices));
#ifndef GNOMON_PASSES_FROXELS_HPP
#define GNOMON_PASSES_FROXELS_HPP

#include "../comparators/froxels.h"
#include "look_up.hpp"

GNOMON_NAMESPACE_BEGIN

/// Slices of width x height froxels without gaps, the nearest first. A column's middle is at + 0.5.
template <class T> struct froxel_view {
    std::span<T> froxels;
    std::size_t width = 0, height = 0, slices = 0;

    constexpr map_view<T> slice(std::size_t index) const
    {
        return {froxels.subspan(index * width * height, width * height), width, height};
    }
    constexpr operator froxel_view<const T>() const { return {froxels, width, height, slices}; }
};

/// Replace the intensities of froxels in the given rows of each slice by intensities of the way from the camera to the
/// froxel's end, through air of this extinction per unit of length.
/// NaN: lit.
/// Source: Wronski 2014
inline void integrate_froxels(froxel_view<float> grid, const froxel_slices<float>& slices, float extinction,
                              row_range rows)
{
    constexpr std::string_view pass = "integrate_froxels";
    GNOMON_EXPECTS(grid.slices > 0, mismatch(pass, "grid.slices", grid.slices, "grid.width", grid.width));
    expect_map(pass, "grid", map_view<float>{grid.froxels, grid.width, grid.height});
    GNOMON_EXPECTS(grid.froxels.size() / grid.slices / grid.width >= grid.height,
                   mismatch(pass, "grid.froxels.size()", grid.froxels.size(), "grid.slices", grid.slices));
    expect_rows(pass, grid.slice(0), rows);
    const std::size_t first = rows.first * grid.width, count = (rows.last - rows.first) * grid.width;
    float from = 0;
    transmittance_share<float> sum{0, 1};
    for (std::size_t k = 0; k < grid.slices; ++k) {
        const float to = froxel_distance(float(k), slices);
        sum = transmittance_share_add(sum, froxel_weight(extinction, from, to));
        from = to;
        const std::span<float> here = grid.slice(k).texels.subspan(first, count);
        const std::span<const float> before = grid.slice(k > 0 ? k - 1 : 0).texels.subspan(first, count);
        for (std::size_t i = 0; i < count; ++i) {
            const float intensity = saturate_or_zero(here[i]);
            here[i] = k > 0 ? before[i] + sum.share * (intensity - before[i]) : intensity;
        }
    }
}

/// Shadow intensity in [0, 1] at column x, row y and slice, interpolated linearly along all three. At the edge of the grid the
/// outermost froxels count.
/// Domain: any position.
/// NaN: 0, lit.
inline float froxel_intensity(froxel_view<const float> grid, float x, float y, float slice)
{
    if ((std::isunordered)(x, y) || (std::isnan)(slice) || grid.froxels.empty()) return 0;
    const auto nx = detail::neighbours_of<border_mode::clamp>(x - 0.5f, grid.width);
    const auto ny = detail::neighbours_of<border_mode::clamp>(y - 0.5f, grid.height);
    const auto nk = detail::neighbours_of<border_mode::clamp>(slice, grid.slices);
    const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
    const auto at = [&](std::size_t k) {
        const map_view<const float> map = grid.slice(k);
        return mix(mix(map(nx.lower, ny.lower), map(nx.upper, ny.lower), nx.fraction),
                   mix(map(nx.lower, ny.upper), map(nx.upper, ny.upper), nx.fraction), ny.fraction);
    };
    return saturate_or_zero(mix(at(nk.lower), at(nk.upper), nk.fraction));
}

GNOMON_NAMESPACE_END
#endif
