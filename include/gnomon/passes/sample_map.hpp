// A stochastic shadow map: several samples for each texel, each at a place and at a time of its own.
#ifndef GNOMON_PASSES_SAMPLE_MAP_HPP
#define GNOMON_PASSES_SAMPLE_MAP_HPP

#include "../motion/layers/stochastic_sample.h"
#include "expects.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

GNOMON_NAMESPACE_BEGIN

/// A map of width x height texels, row by row, of `samples` samples each. Sample k of texel i is of[i samples + k]. Its
/// time is in stratum k of `samples` (stratified_time), and its place in the texel: x to x + 1 and y to y + 1.
template <class T> struct sample_map {
    std::size_t width = 0, height = 0, samples = 0;
    std::span<const stochastic_sample<T>> of;

    /// The samples of a texel.
    std::span<const stochastic_sample<T>> operator()(std::size_t x, std::size_t y) const
    {
        return of.subspan((y * width + x) * samples, samples);
    }
};

namespace detail {

/// The product of three sizes, or the largest number where that is beyond it.
constexpr std::size_t product_or_most(std::size_t a, std::size_t b, std::size_t c)
{
    constexpr std::size_t most = (std::numeric_limits<std::size_t>::max)();
    if (a == 0 || b == 0 || c == 0) return 0;
    return a <= most / b && a * b <= most / c ? a * b * c : most;
}

} // namespace detail

/// Check that the map has texels and samples, and that its array has as many.
template <class T> void check_shape(const sample_map<T>& map, std::string_view pass)
{
    GNOMON_EXPECTS(map.width > 0 && map.height > 0, mismatch(pass, "map.width", map.width, "map.height", map.height));
    GNOMON_EXPECTS(map.samples > 0, mismatch(pass, "map.samples", map.samples, "the least", 1));
    const std::size_t all = detail::product_or_most(map.width, map.height, map.samples);
    GNOMON_EXPECTS(map.of.size() == all,
                   mismatch(pass, "map.of.size()", map.of.size(), "map.width map.height map.samples", all));
}

GNOMON_NAMESPACE_END
#endif
