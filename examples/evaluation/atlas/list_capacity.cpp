// Lists of a few ranges in a texel that many surfaces pass: a full list merges two ranges into one in front of both.
#include "sweep.hpp"

#include <gnomon/motion/range/range_list.h>

#include <cmath>
#include <string>
#include <vector>

namespace gnomon::evaluation {

namespace {

constexpr int lists_per_point = 8;
constexpr float background = 0.9f, no_surface = -3;

// Surfaces at random depths, each in front of the texel for the same part of the shutter interval. The numbers are
// additive recurrences by powers of the inverse plastic ratio.
std::vector<depth_time_range<float>> passing(int count, double duration, int list)
{
    const auto between = [&](int i, double ratio) { return std::fmod((100.0 * list + i + 1) * ratio, 1); };
    std::vector<depth_time_range<float>> result;
    for (int i = 0; i < count; ++i) {
        const double begin = (1 - duration) * between(i, 0.8191725133961645);
        const double z = -0.9 + 1.6 * between(i, 0.6710436067037893),
                     change = 0.4 * between(i, 0.5497004779019703) - 0.2;
        result.push_back({float(begin), float(begin + duration), float(z - change * duration),
                          float(z + change * duration), float(i)});
    }
    return result;
}

// The root mean square error over receivers on the background and on all surfaces, at 16 times each.
template <int Capacity> double error(double count, double duration)
{
    double squares = 0, receivers = 0;
    for (int n = 0; n < lists_per_point; ++n) {
        const auto ranges = passing(int(std::lround(count)), duration, n);
        auto list = range_list_make<float, Capacity>(ranges.front());
        for (const auto& r : ranges) list = range_list_insert(list, r);
        const auto compare = [&](float t, float z, float id) {
            float exact = 0;
            for (const auto& r : ranges) exact = std::max(exact, range_intensity(r, t, z, id, 0.0f));
            const double difference = double(range_list_intensity(list, t, z, id, 0.0f) - exact);
            squares += difference * difference, ++receivers;
        };
        for (int k = 0; k < 16; ++k) {
            const float share = (float(k) + 0.5f) / 16;
            compare(share, background, no_surface);
            for (const auto& r : ranges) {
                const float t = r.t0 + share * (r.t1 - r.t0);
                compare(t, range_depth(r, t), r.id);
            }
        }
    }
    return std::sqrt(squares / receivers);
}

template <int Capacity> sweep_layer listed()
{
    const std::string number = std::to_string(Capacity);
    return {"capacity_" + number, "lists of " + number + " ranges", error<Capacity>};
}

const registered<sweep> entry{sweep{
    .id = "list_capacity",
    .label = "Capacity of lists of ranges",
    .order = 230,
    .text =
        "Surfaces at random depths pass a texel, each for a part of the shutter interval. Receivers are the surfaces "
        "themselves and what is behind them. A list without a capacity is exact.",
    .x = {"count", "number of surfaces", scale::linear, 1, 32, 32},
    .y = {"duration", "part of the shutter interval for which each covers the texel", scale::log, 0.02, 1, 12},
    .error_label = "root mean square error",
    .threshold = 0.1,
    .layers = [] {
        return std::vector{listed<4>(), listed<8>(), listed<16>()};
    }}};

} // namespace

} // namespace gnomon::evaluation
