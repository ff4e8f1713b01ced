// Look-ups in maps of ranges with opacities: against the mean over many times by definition, static and moving; opaque
// lists against those of resolve; long lists; and shapes.
#include "random_maps.hpp"

#include <gnomon/passes/range/translucent.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Lists of up to `most` ranges that overlap in time.
template <class T> struct veiled_map {
    std::vector<std::uint32_t> first;
    std::vector<depth_time_range<T>> ranges;
    std::vector<T> opacities;

    veiled_map(bit_source& bits, std::uint64_t most, bool opaque) : first(range_map<T>::texels(width, height) + 1)
    {
        std::vector<std::uint32_t> texels;
        std::vector<depth_time_range<T>> all;
        for (std::size_t i = 0; i < width * height; ++i)
            for (std::uint64_t n = bits.below(most + 1); n > 0; --n) {
                const double a = bits.uniform(0, 1), b = bits.uniform(0, 1);
                texels.push_back(std::uint32_t(range_map<T>::texel(width, i % width, i / width)));
                all.push_back(
                    range_between(T(a), T(bits.uniform(-1, 1)), T(b), T(bits.uniform(-1, 1)), T(bits.below(5))));
            }
        ranges.resize(all.size());
        sort_into_lists<T>(texels, all, first, ranges);
        const double densest = most > 32 ? 0.1 : 1; // so that light passes long lists
        for (std::size_t i = 0; i < all.size(); ++i) opacities.push_back(opaque ? T(1) : T(bits.uniform(0, densest)));
    }
    translucent_range_map<T> map() const { return {{width, height, first, ranges}, opacities}; }
};

constexpr int times = 8192;
constexpr double sampling = 2e-3; // begins, ends and crossings of ranges fall between two times: signs differ

/// The opacity of a texel in front of a receiver at time t, by definition.
template <class T> double opacity_at(const translucent_range_map<T>& map, std::size_t texel, double t, double z, T id)
{
    double transmittance = 1;
    for (std::size_t k = map.lists.first[texel]; k < map.lists.first[texel + 1]; ++k) {
        const auto& r = map.lists.ranges[k];
        if (!(double(r.t0) <= t && t < double(r.t1)) || r.id == id) continue;
        const double passed = (t - double(r.t0)) / (double(r.t1) - double(r.t0));
        if (double(r.z0) * (1 - passed) + double(r.z1) * passed < z) transmittance *= 1 - double(map.opacities[k]);
    }
    return 1 - transmittance;
}

/// The mean over many times of bilinear look-ups along a path.
template <class T> double mean_over_times(const translucent_range_map<T>& map, const receiver_path<T>& p)
{
    double sum = 0;
    for (int n = 0; n < times; ++n) {
        const double s = (n + 0.5) / times, t = double(p.depth.t0) * (1 - s) + double(p.depth.t1) * s;
        const double x = double(p.x0) * (1 - s) + double(p.x1) * s - 0.5;
        const double y = double(p.y0) * (1 - s) + double(p.y1) * s - 0.5;
        const double z = double(p.depth.z0) * (1 - s) + double(p.depth.z1) * s;
        const double column = std::floor(x), row = std::floor(y), u = x - column, v = y - row;
        detail::for_each_texel(map.lists, column, row, 1, [&](int i, int j, std::size_t texel) {
            sum += (i ? u : 1 - u) * (j ? v : 1 - v) * opacity_at(map, texel, t, z, p.depth.id) / times;
        });
    }
    return sum;
}

} // namespace

TEST_CASE_TEMPLATE("translucent look-ups are the mean over many times, static and moving, for lists of any length", T,
                   float, double)
{
    bit_source bits(81);
    for (std::int64_t n = 0; n < test::effort(60); ++n) {
        const veiled_map<T> veiled(bits, n % 4 == 0 ? 60 : 5, false); // 60 do not fit into the look-up's own memory
        receiver_path<T> path = any_path<T>(bits);
        CHECK(std::abs(double(moving_intensity(veiled.map(), path, path.depth.t0, path.depth.t1)) -
                       mean_over_times(veiled.map(), path)) <= sampling);
        path.x1 = path.x0, path.y1 = path.y0, path.depth.z1 = path.depth.z0;
        const auto state = static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1);
        const double placed = double(static_intensity(veiled.map(), path.x0, path.y0, state));
        CHECK(std::abs(placed - mean_over_times(veiled.map(), path)) <= sampling);
        CHECK(std::abs(double(moving_intensity(veiled.map(), path, path.depth.t0, path.depth.t1)) - placed) <=
              1e4 * double(std::numeric_limits<T>::epsilon()));
    }
}

TEST_CASE("opaque lists give the answer of their resolved lists, by any shutter")
{
    using T = double;
    bit_source bits(82);
    for (std::int64_t n = 0; n < test::effort(200); ++n) {
        const veiled_map<T> opaque(bits, 6, true);
        std::vector<std::uint32_t> texels, first(opaque.first.size());
        std::vector<depth_time_range<T>> all;
        const range_map<T> lists = opaque.map().lists;
        for (std::size_t i = 0; i + 1 < first.size(); ++i) {
            std::vector<visible_span<T>> room(resolve_capacity(lists[i].size(), range_ids::any));
            for (const auto& s : resolve_ranges<T>(lists[i], room, range_ids::any)) {
                texels.push_back(std::uint32_t(i));
                all.push_back(range_of<T>(lists[i], s));
            }
        }
        std::vector<depth_time_range<T>> ranges(all.size());
        sort_into_lists<T>(texels, all, first, ranges);
        const range_map<T> resolved{width, height, first, ranges};
        const receiver_path<T> path = any_path<T>(bits);
        const auto state = static_receiver_begin(path.depth.z0, path.depth.id, T(0.1), T(0.9));
        const auto check = [&](const auto& shutter) {
            const int look_ups = 1 + int(n % 3);
            CHECK(std::abs(static_intensity(opaque.map(), path.x0, path.y0, state, look_ups, shutter) -
                           static_intensity(resolved, path.x0, path.y0, state, look_ups, shutter)) <= 1e-4);
            CHECK(std::abs(moving_intensity(opaque.map(), path, T(0.1), T(0.9), look_ups, shutter) -
                           moving_intensity(resolved, path, T(0.1), T(0.9), look_ups, shutter)) <= 1e-4);
        };
        check(box_shutter{});
        check(tent_shutter{});
    }
}

TEST_CASE("opacities match the ranges of their map, and places beside it are lit")
{
    bit_source bits(83);
    const veiled_map<float> veiled(bits, 4, false);
    translucent_range_map<float> map = veiled.map();
    CHECK_NOTHROW(check_shape(map, "test"));
    map.opacities = map.opacities.first(map.opacities.size() - 1);
    CHECK_THROWS_AS(check_shape(map, "test"), std::invalid_argument);
    const auto state = static_receiver_begin(2.f, 9.f, 0.f, 1.f);
    CHECK(static_intensity(veiled.map(), -5.f, 3.f, state) == 0);
    CHECK(static_intensity(veiled.map(), std::numeric_limits<float>::quiet_NaN(), 3.f, state) == 0);
    CHECK_THROWS_AS(static_intensity(veiled.map(), 1.f, 1.f, state, 0), std::invalid_argument);
}
