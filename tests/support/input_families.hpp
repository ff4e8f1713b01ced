// The families that inputs of kernels are drawn from: the words of kernels.txt. Numbers of a row that belong together come
// from one situation (situations.hpp): a depth distribution, a receiver at a critical depth, and a texel of the distribution. Those of
// motion are in motion_families.hpp.
#pragma once

#include "far_planes.hpp"
#include "motion_families.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/scattering/transmittance_weights.h>
#include <gnomon/soft/summed_area.h>
#include <gnomon/storage/absorbance4.h>
#include <gnomon/storage/convolution.h>
#include <gnomon/storage/exponential.h>
#include <gnomon/storage/layered_variance.h>
#include <gnomon/storage/variance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::test {

/// Absorbances of so many channels of light, and their mean times the moments of the situation.
template <class T> void put_absorbance(row_writer<T>& put, const situation& s, bit_source& bits, int channels)
{
    double mean = 0;
    for (int k = 0; k < channels; ++k) {
        const double absorbance = std::exp2(bits.uniform(-12, 4));
        put(absorbance);
        mean += absorbance / channels;
    }
    for (std::size_t k = 0; k < 4; ++k) put(mean * s.b[k]);
}

/// The sums of codes of these channels over a rectangle, its area, and the scale.
template <class T, std::size_t n> std::array<T, n + 2> any_sums(bit_source& bits, const std::array<T, n>& channels)
{
    const T area = T(bits.uniform(1, 784)), scale = summed_area_scale(T(784));
    std::array<T, n + 2> r{};
    for (std::size_t k = 0; k < n; ++k) r[k] = channels[k] * area * scale;
    r[n] = area, r[n + 1] = scale;
    return r;
}

template <class T>
inline constexpr input_family<T> input_families[] = {
    // Single numbers.
    {"number", 1, [](auto put, const situation&, bit_source& bits) { put(any_number<T>(bits)); }},
    {"sign", 1, [](auto put, const situation&, bit_source& bits) { put(bits.chance(0.5) ? 1 : -1); }},
    {"unit", 1, [](auto put, const situation&, bit_source& bits) { put(bits.chance(0.1) ? 1 : bits.uniform(0, 1)); }},
    {"noise", 1, [](auto put, const situation&, bit_source& bits) { put(std::exp2(bits.uniform(-26, -8))); }},
    {"angle", 1, [](auto put, const situation&, bit_source& bits) { put(bits.uniform(-100, 100)); }},
    {"exponent", 1, [](auto put, const situation&, bit_source& bits) { put(bits.uniform(0.5, 44)); }},
    {"warped", 1, [](auto put, const situation& s, bit_source& bits) { put(std::exp(s.texel * bits.uniform(1, 40))); }},
    {"term", 1, [](auto put, const situation&, bit_source& bits) { put(double(1 + bits.below(16))); }},
    // Depths and moments.
    {"depth", 1, [](auto put, const situation& s, bit_source&) { put(s.receiver); }},
    {"texel", 1, [](auto put, const situation& s, bit_source&) { put(s.texel); }},
    {"moments2", 2, [](auto put, const situation& s, bit_source&) { put(s.b[0]), put(s.b[1]); }},
    {"moments3", 3, [](auto put, const situation& s, bit_source&) { put(s.b[0]), put(s.b[1]), put(s.b[2]); }},
    {"moments4", 4, [](auto put, const situation& s, bit_source&) { put(moments4_in<T>(s)); }},
    {"moments6", 6, [](auto put, const situation& s, bit_source&) { put(moments6_in<T>(s)); }},
    {"channels4", 4, [](auto put, const situation& s, bit_source&) { put(theta4(moments4_in<T>(s))); }},
    {"half4", 4,
     [](auto put, const situation& s, bit_source&) { put(channels4_shifted(theta4(moments4_in<T>(s)), T(-0.5))); }},
    {"absorbance4", 5, [](auto put, const situation& s, bit_source& bits) { put_absorbance<T>(put, s, bits, 1); }},
    {"channels5", 5,
     [](auto put, const situation& s, bit_source& bits) {
         const auto near = absorbance4_half_encode(T(s.texel), T(bits.uniform(0, 1)));
         const auto far = absorbance4_half_encode(T(s.receiver), T(bits.uniform(0, 1)));
         put(channels5<T>{near.c1 + far.c1, near.c2 + far.c2, near.c3 + far.c3, near.c4 + far.c4, near.c5 + far.c5});
     }},
    {"coloured_absorbance4", 7,
     [](auto put, const situation& s, bit_source& bits) { put_absorbance<T>(put, s, bits, 3); }},
    {"channels6", 6, [](auto put, const situation& s, bit_source&) { put(theta6(moments6_in<T>(s))); }},
    {"channels1", 1,
     [](auto put, const situation& s, bit_source& bits) {
         put(mixture<T>(s, bits, [](T z) { return exponential_float_encode(z); }));
     }},
    {"channels2", 2,
     [](auto put, const situation& s, bit_source& bits) {
         put(mixture<T>(s, bits, [](T z) { return variance_unorm16_encode(z); }));
     }},
    {"channels8", 8,
     [](auto put, const situation& s, bit_source& bits) {
         put(mixture<T>(s, bits, [](T z) { return layered_variance_unorm16_encode(z); }));
     }},
    {"channels32", 32,
     [](auto put, const situation& s, bit_source& bits) {
         put(mixture<T>(s, bits, [](T z) { return convolution_unorm8_encode(z); }));
     }},
    {"interval", 2,
     [](auto put, const situation& s, bit_source& bits) {
         const double reach = std::exp2(bits.uniform(-20, 0));
         put(std::max(std::min(s.texel, s.receiver) - reach, -1.0));
         put(std::min(std::max(s.texel, s.receiver) + reach, 1.0));
     }},
    {"hankel4", 4, [](auto put, const situation& s, bit_source& bits) { put(any_hankel4<T>(s, bits)); }},
    {"hankel6", 8, [](auto put, const situation& s, bit_source& bits) { put(any_hankel6<T>(s, bits)); }},
    {"distribution3", 6,
     [](auto put, const situation& s, bit_source& bits) {
         put(hamburger4_distribution(any_hankel4<T>(s, bits), T(s.receiver)));
     }},
    {"bounds", 3,
     [](auto put, const situation&, bit_source& bits) {
         const double lower = bits.uniform(0, 1), weight = bits.uniform(0, 1 - lower);
         put(lower), put(lower + weight), put(weight);
     }},
    // The moments of both warps, of a mixture of two depths.
    {"warped4", 4,
     [](auto put, const situation& s, bit_source& bits) {
         const double c = bits.uniform(1, 40), d = 5.54, w = bits.uniform(0, 1);
         const auto mean = [&](double e) { return w * std::exp(e * s.texel) + (1 - w) * std::exp(e * s.b[0]); };
         put(mean(c)), put(mean(2 * c)), put(-mean(-d)), put(mean(-2 * d));
     }},
    // Summed-area tables: the most texels of a look-up, the scale for them, rectangles in a map, and sums over rectangles
    // with their area and scale.
    {"texels", 1, [](auto put, const situation&, bit_source& bits) { put(double(4 + bits.below(4093))); }},
    {"scale", 1,
     [](auto put, const situation&, bit_source& bits) { put(double(summed_area_scale(T(4 + bits.below(4093))))); }},
    {"rectangle", 4,
     [](auto put, const situation&, bit_source& bits) {
         const double x = bits.uniform(-8, 1000), y = bits.uniform(-8, 1000), width = std::exp2(bits.uniform(-3, 7));
         put(x), put(y), put(x + width), put(y + (bits.chance(0.3) ? width : std::exp2(bits.uniform(-3, 7))));
     }},
    {"parts", 7,
     [](auto put, const situation&, bit_source& bits) {
         const double begin = bits.uniform(0, 1000);
         put(summed_area_split(T(begin), T(begin + std::exp2(bits.uniform(-3, 7)))));
     }},
    {"summed1", 3,
     [](auto put, const situation&, bit_source& bits) { put(any_sums<T>(bits, std::array{T(bits.uniform(0, 1))})); }},
    {"summed2", 4,
     [](auto put, const situation& s, bit_source& bits) {
         put(any_sums<T>(bits, std::array{T((1 + s.b[0]) / 2), T(s.b[1])}));
     }},
    {"summed4", 6,
     [](auto put, const situation& s, bit_source& bits) {
         put(any_sums<T>(bits, gnomon_bit_cast<std::array<T, 4>>(theta4(moments4_in<T>(s)))));
     }},
    {"summed6", 8,
     [](auto put, const situation& s, bit_source& bits) {
         put(any_sums<T>(bits, gnomon_bit_cast<std::array<T, 6>>(theta6(moments6_in<T>(s)))));
     }},
    // Single scattering: a map of angles to depths; the far plane of a camera that looks anywhere; a sum of weights.
    {"rectified_range", 2,
     [](auto put, const situation&, bit_source& bits) {
         put(rectified_polar_range(T(bits.uniform(0, 1)), T(bits.uniform(1, 3.14))));
     }},
    {"far_plane", 12, [](auto put, const situation&, bit_source& bits) { put(any_far_plane<T>(bits)); }},
    {"transmittance_share", 2,
     [](auto put, const situation&, bit_source& bits) {
         put(transmittance_share_add(transmittance_share_begin(T(bits.uniform(0, 4))), T(bits.uniform(0, 1))));
     }},
    // Arithmetic.
    {"monic_cubic", 3,
     [](auto put, const situation&, bit_source& bits) {
         for (const double c : monic_cubic(bits)) put(c);
     }},
    {"layer", 3,
     [](auto put, const situation&, bit_source& bits) {
         put(bits.uniform(-1, 1)), put(bits.uniform(1, 8)), put(std::exp2(bits.uniform(-26, -8)));
     }},
    // Fourier series: settings and phases.
    {"series", 4,
     [](auto put, const situation&, bit_source& bits) {
         put(convolution_settings<T>{T(1 + bits.below(16)), T(bits.uniform(0, 3)), T(bits.uniform(0, 0.1)),
                                     T(bits.uniform(0.5, 1))});
     }},
    {"phase", 4,
     [](auto put, const situation& s, bit_source& bits) {
         put(convolution_phase_at(T(s.receiver), T(bits.uniform(0.5, 1))));
     }},
};

/// The family of this name, null if there is none.
template <class T> const input_family<T>* find_family(std::string_view name)
{
    const auto named = [&](const input_family<T>& family) { return family.name == name; };
    const auto* found = std::find_if(std::begin(input_families<T>), std::end(input_families<T>), named);
    if (found != std::end(input_families<T>)) return found;
    found = std::find_if(std::begin(motion_families<T>), std::end(motion_families<T>), named);
    return found != std::end(motion_families<T>) ? found : nullptr;
}

} // namespace gnomon::test
