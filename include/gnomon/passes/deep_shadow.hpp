// Deep shadow maps (motion/range/deep_shadow.h): the layers of all texels one after the other in one array, and a table
// of where those of a texel begin. They come from depths of samples, with a step for each, or from the resolved ranges
// that samples converge to. The layers are counted first, so that the caller's memory fits:
//
//     std::vector<std::uint32_t> first(width * height + 1);
//     count_deep_layers(depths, samples, tolerance, std::span(first));      sorts the depths of each texel
//     std::vector<deep_layer<float>> layers(first.back());
//     fill_deep_layers(depths, samples, tolerance, std::span(first), std::span(layers));
//     const deep_shadow_map<float> map{width, height, first, layers};
//     float shadow = deep_intensity(map, x, y, z_f);
#ifndef GNOMON_PASSES_DEEP_SHADOW_HPP
#define GNOMON_PASSES_DEEP_SHADOW_HPP

#include "../motion/range/deep_shadow.h"
#include "range/taps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

GNOMON_NAMESPACE_BEGIN

/// A map of width x height texels, row by row. Texel i has the layers first[i] to first[i + 1] - 1, from near to far.
template <class T> struct deep_shadow_map {
    std::size_t width = 0, height = 0;
    std::span<const std::uint32_t> first;
    std::span<const deep_layer<T>> layers;

    static constexpr std::size_t texel(std::size_t width, std::size_t x, std::size_t y) { return y * width + x; }

    std::span<const deep_layer<T>> operator[](std::size_t i) const
    {
        return layers.subspan(first[i], first[i + 1] - first[i]);
    }
};

namespace detail {

/// Call keep(layer) for each layer of the polyline whose vertices are those that vertices(add) adds.
template <class T, class Vertices, class Keep>
void compress_deep(T tolerance, const Vertices& vertices, const Keep& keep)
{
    deep_window<T> window = deep_window_begin(tolerance);
    vertices([&](T z, T v) {
        window = deep_window_add(window, z, v);
        if (window.layer.opacity > 0) keep(window.layer);
    });
    const deep_layer<T> last = deep_window_end(window);
    if (last.opacity > 0) keep(last);
}

/// Call add(z, v) for the vertices of sorted depths. Those at depth 1, as of a cleared map, shadow nothing.
template <class T, class Add> void deep_vertices_of_depths(std::span<const T> sorted, const Add& add)
{
    const T n = T(sorted.size());
    for (std::size_t k = 0; k < sorted.size() && sorted[k] < 1;) {
        const T z = sorted[k];
        add(z, 1 - T(k) / n);
        while (k < sorted.size() && sorted[k] == z) ++k;
        add(z, 1 - T(k) / n);
    }
}

/// Call add(z, v) for the vertices of a resolved list: at the ends of its ranges, in order of depth.
template <class T, class Add> void deep_vertices_of_ranges(std::span<const depth_time_range<T>> list, const Add& add)
{
    const auto for_each = [&](const auto& visit) { for_each_counted(list, T(range_nothing), visit); };
    for (T last = -T(range_far);;) {
        T z = T(range_far);
        for_each([&](const depth_time_range<T>& r) {
            for (const T end : {r.z0, r.z1})
                if (last < end && end < z) z = end;
        });
        if (!(z < T(range_far))) return;
        T before = 1, level = 0;
        for_each([&](const depth_time_range<T>& r) {
            before -= deep_shadow_share(r, z);
            if (r.z0 == z && r.z1 == z) level += range_duration(range_clip(r, T(0), T(1)));
        });
        add(z, before);
        add(z, before - level);
        last = z;
    }
}

/// Count the layers of texel i, whose vertices are those that vertices(i, add) adds, in first[i]; then find the begins.
template <class T, class Vertices>
void count_deep(T tolerance, std::span<std::uint32_t> first, const Vertices& vertices)
{
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
        first[i] = 0;
        compress_deep(
            tolerance, [&](const auto& add) { vertices(i, add); }, [&](const deep_layer<T>&) { ++first[i]; });
    }
    first.back() = 0;
    begins_from_counts(first);
}

/// Write the layers of each texel, from its begin on.
template <class T, class Vertices>
void fill_deep(T tolerance, std::span<const std::uint32_t> first, std::span<deep_layer<T>> layers,
               const Vertices& vertices)
{
    GNOMON_EXPECTS(layers.size() == first.back(),
                   mismatch("fill_deep_layers", "layers.size()", layers.size(), "first.back()", first.back()));
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
        std::size_t next = first[i];
        compress_deep(
            tolerance, [&](const auto& add) { vertices(i, add); },
            [&](const deep_layer<T>& layer) {
                if (next < first[i + 1]) layers[next++] = layer;
            });
        while (next < first[i + 1]) layers[next++] = {T(1), T(1), T(0)}; // counted with another tolerance
    }
}

/// Check that a table of begins has one for each texel, and one more.
inline void expect_begins(std::string_view pass, std::size_t firsts, std::string_view texels_and_one,
                          std::size_t texels)
{
    GNOMON_EXPECTS(firsts == texels + 1, mismatch(pass, "first.size()", firsts, texels_and_one, texels + 1));
}

/// Check that there are depths, `samples` for each texel.
inline void expect_deep_samples(std::string_view pass, std::size_t depths, std::size_t samples, std::size_t firsts)
{
    GNOMON_EXPECTS(samples > 0, mismatch(pass, "samples", samples, "the least", 1));
    GNOMON_EXPECTS(depths > 0 && depths % samples == 0,
                   mismatch(pass, "depths.size()", depths, "samples, of which it has to be a multiple,", samples));
    expect_begins(pass, firsts, "depths.size() / samples + 1", depths / samples);
}

} // namespace detail

/// Sort the depths of each texel, those of texel i from i samples on, and find where the layers of each begin. The last
/// number of first is that of all layers. Depths of 1 and beyond shadow nothing.
/// NaN: depth 1.
template <class T>
void count_deep_layers(std::span<T> depths, std::size_t samples, T tolerance, std::span<std::uint32_t> first)
{
    detail::expect_deep_samples("count_deep_layers", depths.size(), samples, first.size());
    for (std::size_t i = 0; i < depths.size(); i += samples) {
        const std::span<T> of = depths.subspan(i, samples);
        for (T& z : of) z = z < 1 ? z : T(1);
        std::sort(of.begin(), of.end());
    }
    detail::count_deep(tolerance, first, [&](std::size_t i, const auto& add) {
        detail::deep_vertices_of_depths(std::span<const T>(depths.subspan(i * samples, samples)), add);
    });
}

/// Fill the layers of all texels from depths that count_deep_layers has sorted, with the same tolerance.
/// Error: deep_window_add.
template <class T>
void fill_deep_layers(std::span<const T> depths, std::size_t samples, T tolerance, std::span<const std::uint32_t> first,
                      std::span<deep_layer<T>> layers)
{
    detail::expect_deep_samples("fill_deep_layers", depths.size(), samples, first.size());
    detail::fill_deep(tolerance, first, layers, [&](std::size_t i, const auto& add) {
        detail::deep_vertices_of_depths(depths.subspan(i * samples, samples), add);
    });
}

/// Find where the layers of each texel of a map of resolved ranges begin, width height + 1 numbers. The last one is that
/// of all layers.
template <class T> void count_deep_layers(const range_map<T>& map, T tolerance, std::span<std::uint32_t> first)
{
    check_shape(map, "count_deep_layers");
    detail::expect_begins("count_deep_layers", first.size(), "map.width map.height + 1", map.width * map.height);
    detail::count_deep(tolerance, first, [&](std::size_t i, const auto& add) {
        detail::deep_vertices_of_ranges(map(i % map.width, i / map.width), add);
    });
}

/// Fill the layers of all texels from a map of resolved ranges, with the tolerance that they were counted with.
/// Error: deep_window_add, and 8 2^-p for each range of the texel.
template <class T>
void fill_deep_layers(const range_map<T>& map, T tolerance, std::span<const std::uint32_t> first,
                      std::span<deep_layer<T>> layers)
{
    check_shape(map, "fill_deep_layers");
    detail::expect_begins("fill_deep_layers", first.size(), "map.width map.height + 1", map.width * map.height);
    detail::fill_deep(tolerance, first, layers, [&](std::size_t i, const auto& add) {
        detail::deep_vertices_of_ranges(map(i % map.width, i / map.width), add);
    });
}

/// Check the sizes of a map's arrays.
template <class T> void check_shape(const deep_shadow_map<T>& map, std::string_view pass)
{
    GNOMON_EXPECTS(map.width > 0 && map.height > 0, mismatch(pass, "map.width", map.width, "map.height", map.height));
    detail::expect_begins(pass, map.first.size(), "map.width map.height + 1", map.width * map.height);
    GNOMON_EXPECTS(map.first.back() == map.layers.size(),
                   mismatch(pass, "map.first.back()", map.first.back(), "map.layers.size()", map.layers.size()));
}

/// Shadow intensity in [0, 1] of a static receiver at a place in texels and depth z_f, less the depth bias, with
/// percentage-closer filtering of K x K bilinear look-ups, K = look_ups. Outside of the map everything is lit.
/// NaN: 0, lit.
/// Source: Lokovic & Veach 2000
template <class T> T deep_intensity(const deep_shadow_map<T>& map, T x, T y, T z_f, int look_ups = 1)
{
    detail::expect_look_ups("deep_intensity", look_ups);
    T shadow = 0;
    detail::for_each_static_texel(map, x, y, look_ups, [&](T weight, std::size_t texel) {
        T transmittance = 1;
        for (const deep_layer<T>& layer : map[texel]) {
            if (!(layer.z0 < z_f)) break;
            transmittance = deep_shadow_add(transmittance, layer, z_f);
        }
        shadow += weight * deep_shadow_end(transmittance);
    });
    return saturate_or_zero(shadow);
}

GNOMON_NAMESPACE_END
#endif
