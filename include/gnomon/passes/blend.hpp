// Translucent fragments into a shadow map, in its storage format, as hardware blends them (Peters et al. 2017, Sec. 3.2):
// each fragment decodes the texel, blends its channels in float by over (moments/translucency.h), and encodes the result,
// so each rounds to the format. The map holds the opaque surfaces, or is cleared, which stands for the far plane. For
// coloured occluders blend into one map for each channel of light. No allocation; threads may blend fragments of
// different texels.
//
// Absorbance (moments/absorbance.h) is added instead, in any order, in formats of its own: accumulate.
//
//     gnomon::blend<gnomon::moments4_unorm16>(map, back_to_front, gnomon::alpha_test_one_percent);
#ifndef GNOMON_PASSES_BLEND_HPP
#define GNOMON_PASSES_BLEND_HPP

#include "../moments/translucency.h"
#include "../storage/absorbance4.hpp"
#include "map_view.hpp"

#include <cstdint>

GNOMON_NAMESPACE_BEGIN

/// A part of a translucent occluder in texel (x, y) of a map: its signed depth and its opacity.
struct translucent_fragment {
    std::uint32_t x = 0, y = 0;
    float depth = 1, alpha = 0;
};

/// Check that every fragment lies in the map.
template <class T>
void expect_fragments(std::string_view pass, map_view<T> target, std::span<const translucent_fragment> fragments)
{
    for (const translucent_fragment& f : fragments) {
        GNOMON_EXPECTS(f.x < target.width, mismatch(pass, "fragment.x", f.x, "target.width", target.width));
        GNOMON_EXPECTS(f.y < target.height, mismatch(pass, "fragment.y", f.y, "target.height", target.height));
    }
}

/// Blend fragments into the map one after the other, those of a texel back to front. Fragments of an opacity below
/// least_alpha are left out (alpha test), as are those of an opacity of NaN, and of 0 or less.
template <storage_format Format>
void blend(map_view<format_texel<Format>> target, std::span<const translucent_fragment> back_to_front,
           float least_alpha = 0)
{
    expect_map("blend", "target", target);
    expect_fragments("blend", target, back_to_front);
    for (const translucent_fragment& f : back_to_front) {
        if (!(f.alpha > 0) || f.alpha < least_alpha) continue;
        format_texel<Format>& texel = target(f.x, f.y);
        auto below = load_channels<Format>(texel);
        const auto above = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(f.depth));
        for (std::size_t k = 0; k < below.size(); ++k) below[k] = over(below[k], above[k], f.alpha);
        texel = store_channels<Format>(below);
    }
}

/// Add the absorbance of fragments to the map, in any order. Fragments of an opacity below least_alpha are left out (alpha
/// test), as are those of an opacity of NaN, and of 0 or less.
template <absorbance_format Format>
void accumulate(map_view<format_texel<Format>> target, std::span<const translucent_fragment> fragments,
                float least_alpha = 0)
{
    expect_map("accumulate", "target", target);
    expect_fragments("accumulate", target, fragments);
    for (const translucent_fragment& f : fragments) {
        if (!(f.alpha > 0) || f.alpha < least_alpha) continue;
        format_texel<Format>& texel = target(f.x, f.y);
        auto sum = load_channels<Format>(texel);
        const auto added = gnomon_bit_cast<channel_array<Format>>(Format::from_fragment(f.depth, f.alpha));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += added[k];
        texel = store_channels<Format>(sum);
    }
}

GNOMON_NAMESPACE_END
#endif
