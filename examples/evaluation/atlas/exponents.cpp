// Exponents of exponential and exponential variance shadow maps: small ones leak, large ones overflow the format.
#include "region.hpp"
#include "sweep.hpp"

#include <gnomon/filters/exponential.h>
#include <gnomon/filters/exponential_variance.h>
#include <gnomon/numerics/half.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gnomon::evaluation::exponents {

namespace {

constexpr float share = 0.5f; // of the nearer surface

// The largest error of receivers on either of two surfaces.
template <class Intensity> double error(double distance, Intensity intensity)
{
    const std::array depths{float(-distance / 2), float(distance / 2)};
    return std::max(std::abs(double(intensity(depths, depths[0]))),
                    std::abs(double(intensity(depths, depths[1])) - double(share)));
}

double exponential_error(double exponent, double distance)
{
    return error(distance, [&](const std::array<float, 2>& depths, float z_f) {
        const exponential_settings<float> settings{float(exponent)};
        const float mean = share * exponential_encode(depths[0], settings).warped +
                           (1 - share) * exponential_encode(depths[1], settings).warped;
        return exponential_intensity(exponential_moment<float>{mean}, z_f, settings);
    });
}

// Round stores a channel in the format.
template <class Round> double variance_error(double exponent, double distance, Round round)
{
    return error(distance, [&](const std::array<float, 2>& depths, float z_f) {
        const exponential_variance_settings<float> settings{float(exponent), float(exponent), 1e-6f};
        const auto a = exponential_variance_encode(depths[0], settings);
        const auto b = exponential_variance_encode(depths[1], settings);
        const auto mean = [&](float near_value, float far_value) {
            return round(share * round(near_value) + (1 - share) * round(far_value));
        };
        const exponential_variance_moments<float> filtered{
            mean(a.positive, b.positive), mean(a.positive_square, b.positive_square), mean(a.negative, b.negative),
            mean(a.negative_square, b.negative_square)};
        return exponential_variance_intensity(filtered, z_f, settings);
    });
}

std::vector<sweep_layer> layers()
{
    const auto as_float = [](float x) { return x; };
    const auto as_half = [](float x) { return half_decode(half_encode(x)); };
    return {{"exponential_float", "ESM, float", exponential_error},
            {"exponential_variance_half", "EVSM, half float",
             [=](double exponent, double distance) { return variance_error(exponent, distance, as_half); }},
            {"exponential_variance_float", "EVSM, float",
             [=](double exponent, double distance) { return variance_error(exponent, distance, as_float); }}};
}

const registered<sweep> entry{sweep{.id = "exponents",
                                    .label = "Exponent",
                                    .order = 70,
                                    .text =
                                        "Each of two surfaces covers half of the filter region, and receivers lie on "
                                        "both of them. The error is the larger "
                                        "of the two. For exponential variance shadow maps both exponents are the same.",
                                    .x = {"exponent", "exponent", scale::linear, 1, 90, 30},
                                    .y = {"distance", "distance of the surfaces", scale::log, 1e-3, 1.9, 16},
                                    .error_label = "error",
                                    .threshold = 0.1,
                                    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::exponents
