// The families that inputs of kernels of motion are drawn from (input_families.hpp): times, ranges, receivers, triangles,
// prisms, and layers of samples.
#pragma once

#include "deep_inputs.hpp"
#include "layer_inputs.hpp"
#include "prisms.hpp"
#include "situations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace gnomon::test {

/// A writer of structs and scalars, number after number.
template <class T> class row_writer {
  public:
    explicit row_writer(T* at) : at_(at) {}
    void operator()(double x) { *at_++ = T(x); }
    template <class Struct>
    requires std::is_class_v<Struct>
    void operator()(const Struct& s)
    {
        std::memcpy(at_, &s, sizeof s);
        at_ += sizeof s / sizeof(T);
    }

  private:
    T* at_;
};

/// A family of inputs: its name, how many numbers it gives, and how they are drawn.
template <class T> struct input_family {
    std::string_view name;
    std::size_t numbers;
    void (*draw)(row_writer<T> put, const situation& s, bit_source& bits);
};

template <class T>
inline constexpr input_family<T> motion_families[] = {
    // Motion: times and ranges.
    {"time", 1,
     [](auto put, const situation&, bit_source& bits) {
         put(bits.chance(0.2) ? double(bits.below(5)) / 4 : bits.uniform(0, 1));
     }},
    {"line_sample", 3,
     [](auto put, const situation&, bit_source& bits) {
         const int rows = int(bits.below(2));
         put(bits.uniform(0, 1)), put(rows), put(1 - rows);
     }},
    {"index", 1, [](auto put, const situation&, bit_source& bits) { put(double(bits.below(4))); }},
    {"range", 5,
     [](auto put, const situation& s, bit_source& bits) {
         const double a = bits.uniform(0, 1), b = bits.chance(0.1) ? a : bits.uniform(0, 1);
         put(std::min(a, b)), put(std::max(a, b)), put(s.texel), put(bits.chance(0.3) ? s.texel : s.receiver);
         put(double(bits.below(4)));
     }},
    {"shutter_weights", 8,
     [](auto put, const situation&, bit_source& bits) {
         for (int k = 0; k < 8; ++k) put(bits.chance(0.2) ? 0 : bits.uniform(0, 1));
     }},
    // Receivers.
    {"static_receiver", 6,
     [](auto put, const situation& s, bit_source& bits) {
         const double begin = bits.uniform(0, 1), end = bits.uniform(0, 1);
         put(s.receiver), put(double(bits.below(4))), put(std::min(begin, end)), put(std::max(begin, end));
         put(bits.chance(0.5) ? 1 : bits.uniform(0, 1)), put(bits.uniform(0, 1));
     }},
    {"range_summary", 4,
     [](auto put, const situation& s, bit_source& bits) {
         put(s.texel - bits.uniform(0, 1)), put(s.texel), put(bits.uniform(0, 1)), put(double(bits.below(7)) - 2);
     }},
    {"receiver_path", 11,
     [](auto put, const situation& s, bit_source& bits) { put(any_seen_receiver<T>(s, bits).path); }},
    {"texel_sweep", 20,
     [](auto put, const situation& s, bit_source& bits) { put(any_seen_receiver<T>(s, bits).sweep); }},
    {"moving_receiver", 14,
     [](auto put, const situation& s, bit_source& bits) { put(any_seen_receiver<T>(s, bits).state); }},
    {"moving_vector", 6,
     [](auto put, const situation&, bit_source& bits) {
         for (int k = 0; k < 6; ++k) put(bits.uniform(-1, 1));
     }},
    {"range_list", 42, [](auto put, const situation& s, bit_source& bits) { put(any_range_list<T>(s, bits)); }},
    // Moving triangles.
    {"moving_triangle", 24,
     [](auto put, const situation&, bit_source& bits) { put(any_seen_triangle<T>(bits).triangle); }},
    {"moving_vertex", 8,
     [](auto put, const situation&, bit_source& bits) { put(any_seen_triangle<T>(bits).triangle.a); }},
    {"moving_edge", 3, [](auto put, const situation&, bit_source& bits) { put(any_seen_triangle<T>(bits).edges.a); }},
    {"moving_edges", 9, [](auto put, const situation&, bit_source& bits) { put(any_seen_triangle<T>(bits).edges); }},
    {"edge_intervals", 4,
     [](auto put, const situation&, bit_source& bits) {
         put(moving_edge_inside(any_seen_triangle<T>(bits).edges.b, T(bits.chance(0.5) ? 1 : -1)));
     }},
    {"moving_triangle_and_edges", 33,
     [](auto put, const situation&, bit_source& bits) { put(any_seen_triangle<T>(bits)); }},
    {"edge_equation", 9,
     [](auto put, const situation&, bit_source& bits) { put(any_setup_and_triangle<T>(bits).setup.b); }},
    {"triangle_setup", 27,
     [](auto put, const situation&, bit_source& bits) { put(any_setup_and_triangle<T>(bits).setup); }},
    {"setup_and_triangle", 51,
     [](auto put, const situation&, bit_source& bits) { put(any_setup_and_triangle<T>(bits)); }},
    {"depth_setup", 16, [](auto put, const situation&, bit_source& bits) { put(any_depth_setup<T>(bits)); }},
    {"depth_curve", 11, [](auto put, const situation&, bit_source& bits) { put(any_depth_curve<T>(bits)); }},
    {"coverage_intervals", 9,
     [](auto put, const situation&, bit_source& bits) {
         put(moving_coverage(any_seen_triangle<T>(bits).edges, T(1)));
     }},
    // Prisms and covers.
    {"part", 1, [](auto put, const situation&, bit_source& bits) { put(double(bits.below(14))); }},
    {"prism", 48,
     [](auto put, const situation&, bit_source& bits) {
         put(prism_make(any_seen_triangle<T>(bits).triangle, T(bits.chance(0.5))));
     }},
    {"prism_triangle_and_sample", 17,
     [](auto put, const situation&, bit_source& bits) {
         put(any_seen_prism_triangle(any_seen_triangle<T>(bits).triangle, bits));
     }},
    {"prism_fragment", 3, [](auto put, const situation&, bit_source& bits) { put(any_prism_fragment<T>(bits)); }},
    {"prism_pair", 20,
     [](auto put, const situation&, bit_source& bits) {
         prism_pair<T> state = prism_pair_begin(T(bits.below(4)));
         for (std::size_t n = bits.below(6); n > 0; --n) state = prism_pair_add(state, any_prism_fragment<T>(bits));
         put(state);
     }},
    {"timed_fragment", 3, [](auto put, const situation&, bit_source& bits) { put(any_timed_fragment<T>(bits)); }},
    {"fragment_cover", 7,
     [](auto put, const situation&, bit_source& bits) {
         fragment_cover<T> state = fragment_cover_begin(any_timed_fragment<T>(bits));
         for (std::size_t n = bits.below(3); n > 0; --n) state = fragment_cover_add(state, any_timed_fragment<T>(bits));
         put(state);
     }},
    {"range_cover", 7,
     [](auto put, const situation&, bit_source& bits) {
         range_cover<T> state = range_cover_begin(T(1));
         for (std::size_t n = bits.below(3); n > 0; --n) state = range_cover_add(state, any_cover_range<T>(bits));
         put(state);
     }},
    // Deep layers, time moments, and slices of samples.
    {"deep_layer", 3, [](auto put, const situation& s, bit_source& bits) { put(any_deep_layer<T>(s, bits)); }},
    {"deep_window", 12, [](auto put, const situation&, bit_source& bits) { put(any_deep_window<T>(bits)); }},
    {"range_moments4", 6, [](auto put, const situation& s, bit_source& bits) { put(any_range_moments4<T>(s, bits)); }},
    {"time_dependent_sample", 4,
     [](auto put, const situation& s, bit_source& bits) { put(any_time_dependent_sample<T>(s, bits)); }},
    // Layers of moving samples.
    {"stochastic_sample", 8,
     [](auto put, const situation& s, bit_source& bits) { put(any_stochastic_sample<T>(s, bits)); }},
    {"layer_window", 2, [](auto put, const situation& s, bit_source& bits) { put(any_layer_window<T>(s, bits)); }},
    {"layer_runs", 11, [](auto put, const situation& s, bit_source& bits) { put(any_layer_runs<T>(s, bits)); }},
    {"layer_cuts", 3,
     [](auto put, const situation& s, bit_source& bits) { put(layer_cuts_end(any_layer_runs<T>(s, bits), T(4))); }},
    {"layer_motion_sums", 13,
     [](auto put, const situation& s, bit_source& bits) { put(any_layer_motion_sums<T>(s, bits)); }},
    {"layer_motion", 7, [](auto put, const situation& s, bit_source& bits) { put(any_layer_motion<T>(s, bits)); }},
    {"layer_grid", 11, [](auto put, const situation& s, bit_source& bits) { put(any_layer_grid<T>(s, bits)); }},
    {"layer_direction_sums", 6,
     [](auto put, const situation& s, bit_source& bits) { put(any_layer_direction_sums<T>(s, bits)); }},
    {"layer_direction", 5,
     [](auto put, const situation& s, bit_source& bits) {
         put(layer_direction_end(any_layer_direction_sums<T>(s, bits)));
     }},
    {"layer_share", 2,
     [](auto put, const situation&, bit_source& bits) { put(layer_share_of(T(bits.below(6)) - 1, T(bits.below(4)))); }},
    {"layer_sums", 4,
     [](auto put, const situation& s, bit_source& bits) {
         put(any_layer_sums<T, layer_sums<T>>(s, bits, [](auto... x) { return layer_sums_add(x...); }));
     }},
    {"layer_moments4_sums", 6,
     [](auto put, const situation& s, bit_source& bits) {
         put(any_layer_sums<T, layer_moments4_sums<T>>(s, bits, [](auto... x) { return layer_moments4_add(x...); }));
     }},
    {"layer_exponential_sums", 3,
     [](auto put, const situation& s, bit_source& bits) {
         const exponential_settings<T> c{T(40)};
         put(any_layer_sums<T, layer_exponential_sums<T>>(s, bits,
                                                          [&](auto... x) { return layer_exponential_add(x..., c); }));
     }},
    {"layer_footprint", 6,
     [](auto put, const situation& s, bit_source& bits) { put(any_layer_footprint<T>(s, bits)); }},
};

} // namespace gnomon::test
