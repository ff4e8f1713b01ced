// Time-dependent shadow maps (motion/receiver/time_dependent.h): from samples to slices of the shutter interval, and
// look-ups at the time of a receiver, by the nearest texel or by percentage-closer filtering of K x K bilinear look-ups.
// The camera's samples are at any times: a map of N slices answers cameras of any number of samples. Outside of the map
// everything is lit.
//
//     std::vector<time_dependent_sample<float>> texels(samples.of.size());
//     fill_time_dependent(samples, std::span(texels));
//     const time_dependent_map<time_dependent_sample<float>> map{samples.width, samples.height, samples.samples, texels};
//     float shadow = time_dependent_intensity(map, receiver);
//
// A texel keeps of its sample what its depth bias needs: 4 bytes for slope alone, 12 for motion in depth, 16 for all.
#ifndef GNOMON_PASSES_TIME_DEPENDENT_HPP
#define GNOMON_PASSES_TIME_DEPENDENT_HPP

#include "../motion/receiver/time_dependent.h"
#include "range/taps.hpp"
#include "sample_map.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

GNOMON_NAMESPACE_BEGIN

/// The depth of a sample alone: look-ups are biased by the receiver's slope.
template <class T> struct slice_depth {
    T z;

    static constexpr slice_depth of(const time_dependent_sample<T>& s) { return {s.z}; }
    constexpr operator time_dependent_sample<T>() const { return {z, T(0), T(0), T(0)}; }
};

/// Depth, time and motion in depth: look-ups move the sample along in depth, too.
template <class T> struct slice_motion {
    T z, t, d_z;

    static constexpr slice_motion of(const time_dependent_sample<T>& s) { return {s.z, s.t, s.d_z}; }
    constexpr operator time_dependent_sample<T>() const { return {z, t, d_z, T(0)}; }
};

/// A map of width x height texels in each of `slices` equal parts of the shutter interval: slice after slice, row by row.
/// Texel is slice_depth, slice_motion or time_dependent_sample.
template <class Texel> struct time_dependent_map {
    std::size_t width = 0, height = 0, slices = 0;
    std::span<const Texel> texels;

    static constexpr std::size_t texel(std::size_t width, std::size_t x, std::size_t y) { return y * width + x; }
};

/// A receiver at time t: place in texels, depth, and the most that the depth of its surface changes per texel. A
/// constant depth bias, if there is one, is subtracted from z.
template <class T> struct time_dependent_receiver {
    T x, y, z, t, slope;
};

/// Fill the texels of a map, one for each sample: sample k of each texel goes to slice k.
template <class Texel, class T> void fill_time_dependent(const sample_map<T>& from, std::span<Texel> texels)
{
    check_shape(from, "fill_time_dependent");
    GNOMON_EXPECTS(texels.size() == from.of.size(),
                   mismatch("fill_time_dependent", "texels.size()", texels.size(), "from.of.size()", from.of.size()));
    const std::size_t each = from.width * from.height;
    for (std::size_t i = 0; i < each; ++i)
        for (std::size_t k = 0; k < from.samples; ++k) {
            const stochastic_sample<T>& s = from.of[i * from.samples + k];
            const time_dependent_sample<T> kept{s.z, s.t, s.d_z, time_dependent_travel(s.d_x, s.d_y)};
            if constexpr (std::is_same_v<Texel, time_dependent_sample<T>>) texels[k * each + i] = kept;
            else texels[k * each + i] = Texel::of(kept);
        }
}

/// Check that a map has texels and slices, and that its array has as many.
template <class Texel> void check_shape(const time_dependent_map<Texel>& map, std::string_view pass)
{
    GNOMON_EXPECTS(map.width > 0 && map.height > 0, mismatch(pass, "map.width", map.width, "map.height", map.height));
    GNOMON_EXPECTS(map.slices > 0, mismatch(pass, "map.slices", map.slices, "the least", 1));
    const std::size_t all = detail::product_or_most(map.width, map.height, map.slices);
    GNOMON_EXPECTS(map.texels.size() == all,
                   mismatch(pass, "map.texels.size()", map.texels.size(), "map.width map.height map.slices", all));
}

/// Shadow intensity in [0, 1] of a receiver by K x K bilinear look-ups, K = look_ups, in the slice of its time; by the
/// nearest texel for K = 0.
/// NaN: 0, lit.
/// Source: Akenine-Moller 2007, Sec. 4
template <class Texel, class T>
T time_dependent_intensity(const time_dependent_map<Texel>& map, const time_dependent_receiver<T>& r, int look_ups = 1)
{
    if (look_ups != 0) detail::expect_look_ups("time_dependent_intensity", look_ups);
    constexpr T diagonal = T(1.4142135623730951);
    const T texels = diagonal * (T(0.5) * T(look_ups) + T(1));
    const std::size_t slice = std::size_t(slice_of(r.t, T(map.slices)));
    const Texel* const of = map.texels.data() + slice * map.width * map.height;
    percentage_closer<T> state = percentage_closer_begin(r.z);
    const auto add = [&](T weight, std::size_t texel) {
        state = percentage_closer_add(state, time_dependent_biased_depth<T>(of[texel], r.t, r.slope, texels), weight);
    };
    if (look_ups > 0) detail::for_each_static_texel(map, r.x, r.y, look_ups, add);
    else
        detail::for_each_texel(map, texel_below(r.x), texel_below(r.y), 0,
                               [&](int, int, std::size_t texel) { add(T(1), texel); });
    return percentage_closer_end(state);
}

GNOMON_NAMESPACE_END
#endif
