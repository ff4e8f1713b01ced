// Lists of a few ranges in a texel that many surfaces pass: a full list merges two ranges into one in front of both.
#include "sweep.hpp"

#include <gnomon/comparators/interval_list.h>

#include <cmath>
#include <vector>

namespace gnomon::evaluation::list_capacity {

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

// Into a list that merges in front of both ranges, or by weights, not in front, as Gribel et al. 2010 do.
struct in_front {
    auto operator()(const auto& list, const depth_time_range<float>& r) const { return range_list_insert(list, r); }
};
struct by_weights {
    auto operator()(const auto& list, const depth_time_range<float>& r) const
    {
        return interval_list_insert(list, r, interval_weights<float>{0, 1, 1, 0.125f, 0.25f}, 0.0f);
    }
};

// The root mean square error over receivers on the background and on all surfaces, at 16 times each.
template <int Capacity, class Insert> double error(double count, double duration)
{
    double squares = 0, receivers = 0;
    for (int n = 0; n < lists_per_point; ++n) {
        const auto ranges = passing(int(std::lround(count)), duration, n);
        auto list = range_list_make<float, Capacity>(ranges.front());
        for (const auto& r : ranges) list = Insert()(list, r);
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

template <int Capacity, class Insert = in_front> sweep_layer listed(const char* id, const char* label)
{
    return {id, label, error<Capacity, Insert>};
}

std::vector<sweep_layer> layers()
{
    return {listed<4>("capacity_4", "lists of 4 ranges"), listed<8>("capacity_8", "lists of 8 ranges"),
            listed<8, by_weights>("capacity_8_weights", "lists of 8 ranges, merged by weights"),
            listed<16>("capacity_16", "lists of 16 ranges")};
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
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::list_capacity
