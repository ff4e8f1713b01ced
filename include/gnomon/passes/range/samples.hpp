// Samples of a map of depth-time ranges at regular instants: a stochastic shadow map without chance, as ranges are exact
// in time. Each texel is seen at its centre. A texel's times are at one part of their strata. The parts of neighbours are a
// sequence of low discrepancy (Roberts 2018), so that together they fill a stratum evenly.
#ifndef GNOMON_PASSES_RANGE_SAMPLES_HPP
#define GNOMON_PASSES_RANGE_SAMPLES_HPP

#include "../../motion/layers/stochastic_sample.h"
#include "../../motion/triangle/triangle_motion.h"
#include "../map_view.hpp"
#include "map.hpp"

GNOMON_NAMESPACE_BEGIN

/// The part of a stratum, in [0, 1), at which texel (x, y) is seen.
inline float instant_of_texel(std::size_t x, std::size_t y)
{
    // Multiples of 2^-32: 1 / p and 1 / p^2 of the plastic number p.
    const std::uint32_t part = std::uint32_t(x) * 3242174889u + std::uint32_t(y) * 2447445414u;
    return float(part >> 8) * 0x1p-24f;
}

/// Fill the samples of the given rows of texels, `each` for a texel as in sample_map, with the nearest range at their
/// times, or the background. motion(id, x, y, t) returns the triangle_motion of the surface of this id at the texel's
/// centre (x, y). Ranges of id range_mixed become surface 0 without motion, those of id range_nothing the background.
/// NaN: a range with a NaN is left out.
template <class Map, class T, class Motion>
void sample_ranges(const Map& map, std::size_t each, const Motion& motion, std::span<stochastic_sample<T>> samples,
                   row_range rows)
{
    constexpr std::string_view pass = "sample_ranges";
    check_shape(map, pass);
    GNOMON_EXPECTS(
        each > 0 && samples.size() == map.width * map.height * each,
        mismatch(pass, "samples.size()", samples.size(), "width height each", map.width * map.height * each));
    GNOMON_EXPECTS(rows.first <= rows.last, mismatch(pass, "rows.first", rows.first, "rows.last", rows.last));
    GNOMON_EXPECTS(rows.last <= map.height, mismatch(pass, "rows.last", rows.last, "map.height", map.height));
    for (std::size_t y = rows.first; y < rows.last; ++y)
        for (std::size_t x = 0; x < map.width; ++x) {
            const auto list = map[map.texel(map.width, x, y)];
            const T at_x = T(x) + T(0.5), at_y = T(y) + T(0.5), jitter = T(instant_of_texel(x, y));
            for (std::size_t k = 0; k < each; ++k) {
                const T t = stratified_time(T(k), T(each), jitter);
                stochastic_sample<T> s = stochastic_background(at_x, at_y, t);
                T nearest = T(range_far);
                for (const depth_time_range<T>& r : list) {
                    if (!(r.t0 <= t && t < r.t1) || r.id == T(range_nothing)) continue;
                    const T z = range_depth(r, t);
                    if (!(z < nearest)) continue;
                    nearest = z;
                    s.id = r.id;
                }
                if (nearest < T(range_far)) {
                    s.z = nearest;
                    const triangle_motion<T> m = s.id >= 0 ? motion(s.id, at_x, at_y, t) : triangle_motion<T>{};
                    s.d_x = m.d_x;
                    s.d_y = m.d_y;
                    s.d_z = m.d_z;
                    s.id = s.id >= 0 ? s.id : T(0);
                }
                samples[(y * map.width + x) * each + k] = s;
            }
        }
}

GNOMON_NAMESPACE_END
#endif
