// Compression of deep shadow maps: what the tolerance and the number of samples take from a static receiver's shadow.
#include "sweep.hpp"

#include <gnomon/motion/range/deep_shadow.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace gnomon::evaluation::deep_tolerance {

namespace {

constexpr int texels = 8, receivers = 24;
constexpr float background = 0.99f;

// A surface at one depth, in front of the texel for a part of the shutter interval.
struct visit {
    double begin, end;
    float depth;
};

float nearest(const std::vector<visit>& visits, double t)
{
    float z = background;
    for (const visit& v : visits)
        if (v.begin <= t && t < v.end) z = std::min(z, v.depth);
    return z;
}

std::vector<deep_layer<float>> compressed(std::vector<float> depths, double tolerance)
{
    std::ranges::sort(depths);
    std::vector<deep_layer<float>> layers;
    const auto keep = [&](const deep_layer<float>& some) {
        if (some.opacity > 0) layers.push_back(some);
    };
    auto window = deep_window_begin(float(tolerance));
    const auto count = float(depths.size());
    for (std::size_t k = 0; k < depths.size(); ++k)
        for (const std::size_t below : {k, k + 1}) {
            window = deep_window_add(window, depths[k], 1 - float(below) / count);
            keep(window.layer);
        }
    keep(deep_window_end(window));
    return layers;
}

// The root mean square error over static receivers at depths of all kinds, each in the same texel.
double error(int surfaces, double tolerance, double samples)
{
    std::mt19937 random(1);
    const auto number = [&] { return double(random() >> 8) * 0x1p-24; };
    const int n = int(std::lround(samples));
    double squares = 0;
    for (int texel = 0; texel < texels; ++texel) {
        std::vector<visit> visits;
        for (int i = 0; i < surfaces; ++i) {
            const double duration = 0.6 * number(), begin = (1 - duration) * number();
            visits.push_back({begin, begin + duration, float(1.8 * number() - 0.9)});
        }
        std::vector<float> depths;
        for (int k = 0; k < n; ++k) depths.push_back(nearest(visits, (k + number()) / n));
        const auto layers = compressed(depths, tolerance);
        for (int r = 0; r < receivers; ++r) {
            const auto z = float(-1 + 1.98 * (r + 0.5) / receivers);
            constexpr int times = 512;
            double exact = 0;
            for (int k = 0; k < times; ++k) exact += nearest(visits, (k + 0.5) / times) < z ? 1. / times : 0;
            float transmittance = 1;
            for (const auto& some : layers) transmittance = deep_shadow_add(transmittance, some, z);
            const double difference = double(deep_shadow_end(transmittance)) - exact;
            squares += difference * difference;
        }
    }
    return std::sqrt(squares / (texels * receivers));
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const int surfaces : {1, 4, 16})
        result.push_back({"deep_" + std::to_string(surfaces),
                          std::to_string(surfaces) + (surfaces > 1 ? " surfaces" : " surface"),
                          [=](double tolerance, double samples) { return error(surfaces, tolerance, samples); }});
    return result;
}

const registered<sweep> entry{sweep{.id = "deep_tolerance",
                                    .label = "Compression of deep shadow maps",
                                    .order = 235,
                                    .text = "Surfaces at random depths pass a texel, each for a part of the shutter "
                                            "interval. The transmittance of samples at "
                                            "stratified times is compressed to a tolerance. Receivers are static.",
                                    .x = {"tolerance", "tolerance of transmittance", scale::log, 0.001, 0.5, 16},
                                    .y = {"samples", "samples of the texel", scale::log, 2, 256, 8},
                                    .error_label = "root mean square error",
                                    .threshold = 0.05,
                                    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::deep_tolerance
