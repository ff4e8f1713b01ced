// All methods and storage formats over one list of situations (tests/support/depth_situations.hpp), for floats, doubles and
// packs, against the exact shadow intensity: no lit surface is darkened by more than stated, bounds stay below the truth, a
// lone caster casts its shadow from the distance on that docs/conventions.md states, and depths beyond a plane are as on it.
#include "support/depth_situations.hpp"
#include "support/documented.hpp"
#include "support/formats.hpp"
#include "support/reals.hpp"

#include <gnomon/filters/convolution.h>
#include <gnomon/filters/percentage_closer.h>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The channels of a situation in the format, filtered in double, after one rounding of each texel.
template <class Format> std::array<double, channel_count<Format>> filtered(const depth_situation& s)
{
    std::array<double, channel_count<Format>> sum{};
    for (const weighted_depth& c : s.casters) {
        const auto texel = load_channels<Format>(texel_of_depth<Format>(c.z));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += double(c.weight) * double(texel[k]);
    }
    return sum;
}

/// The same after two passes that store their results in the format.
template <class Format> std::array<double, channel_count<Format>> filtered_twice(const depth_situation& s)
{
    std::array<double, channel_count<Format>> sum = filtered<Format>(s);
    for (int pass = 0; pass < 2; ++pass) {
        channel_array<Format> c;
        for (std::size_t k = 0; k < c.size(); ++k) c[k] = float(sum[k]);
        c = load_channels<Format>(store_channels<Format>(c));
        for (std::size_t k = 0; k < c.size(); ++k) sum[k] = double(c[k]);
    }
    return sum;
}

/// The channels of a format as numbers of any type.
template <class Format, class Real>
format_channels<Format, Real> channels_of(const std::array<double, channel_count<Format>>& numbers)
{
    std::array<Real, channel_count<Format>> reals;
    for (std::size_t k = 0; k < reals.size(); ++k) reals[k] = Real(lane_t<Real>(numbers[k]));
    format_channels<Format, Real> c;
    static_assert(sizeof c == sizeof reals);
    std::memcpy(static_cast<void*>(&c), reals.data(), sizeof c);
    return c;
}

/// Moments are bounds after the roundings of a format; other filters where all depths are behind the receiver or at it.
template <class Format> constexpr bool is_bound = requires { Format::bias; };

template <class Format, class Real> void check_intensity(const depth_situation& s, bool twice)
{
    using lane = lane_t<Real>;
    const Real z_f = Real(lane(s.receiver));
    const auto c = channels_of<Format, Real>(twice ? filtered_twice<Format>(s) : filtered<Format>(s));
    std::array<lane, lanes<Real>()> result;
    store<Real>(twice ? Format::filtered_intensity(c, z_f) : Format::intensity(c, z_f), result.data());
    const double darkening = double(twice ? Format::filtered_darkening : Format::darkening), truth = s.truth();
    for (const lane x : result) {
        const double intensity = double(x);
        REQUIRE((0 <= intensity && intensity <= 1));
        if (truth == 0 || is_bound<Format>) REQUIRE(intensity <= truth + darkening);
    }
}

/// Smallest distance behind a lone caster from which on the intensity is at least 0.9, for any depth of the caster.
template <class Format> double shadow_distance(bool twice)
{
    double largest = 0;
    for (int i = 0; i <= 400; ++i) {
        const float z = -1 + 0.005f * float(i);
        const auto c = Format::decode(texel_of_depth<Format>(z));
        for (double d = 1e-7; double(z) + d <= 1; d *= 1.02) {
            const auto z_f = float(double(z) + d);
            if (!((twice ? Format::filtered_intensity(c, z_f) : Format::intensity(c, z_f)) >= 0.9f))
                largest = std::max(largest, 1.02 * d);
        }
    }
    return largest;
}

} // namespace

TEST_CASE_TEMPLATE("every format in every situation: lit surfaces stay lit, moments stay below the truth", T, float,
                   double)
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        for_each_depth_situation([](const depth_situation& s) {
            CAPTURE(s.casters[0].z);
            CAPTURE(s.casters[0].weight);
            CAPTURE(s.receiver);
            const auto check = [&]<class Real>() {
                check_intensity<Format, Real>(s, true);
                // A mixture in float is rounded once more than X_intensity allows for.
                if (s.is_single() || std::is_same_v<lane_t<Real>, double>) check_intensity<Format, Real>(s, false);
            };
            check.template operator()<T>();
#if !defined(__SANITIZE_ADDRESS__) // as of for_each_real
            check.template operator()<plain<T>>();
            check.template operator()<xsimd::make_sized_batch_t<T, 16 / sizeof(T)>>();
#endif
        });
    });
}

TEST_CASE("every format in every situation: depths beyond a plane are as on it")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        for_each_depth_situation([](const depth_situation& s) {
            depth_situation limited = s;
            for (weighted_depth& c : limited.casters) c.z = float(depth_in_range(double(c.z)));
            limited.receiver = std::clamp(s.receiver, -1.0f, 1.0f); // NaN stays NaN
            const auto c = channels_of<Format, float>(filtered<Format>(s)),
                       same = channels_of<Format, float>(filtered<Format>(limited));
            REQUIRE(same_bytes(c, same));
            REQUIRE(Format::intensity(c, s.receiver) == Format::intensity(same, limited.receiver));
            REQUIRE(Format::filtered_intensity(c, s.receiver) == Format::filtered_intensity(same, limited.receiver));
            if (std::isnan(s.receiver)) REQUIRE(larger_intensity<Format>(c, s.receiver) == 0);
        });
    });
}

// The table of docs/conventions.md.
TEST_CASE("a caster that covers the filter casts its shadow from the documented distance on")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        std::string key = "shadow of `";
        key.append(Format::id) += '`';
        const std::vector<double> stated = documented("docs/conventions.md", key);
        REQUIRE(stated.size() == 2);
        for (const bool twice : {false, true}) {
            const double measured = shadow_distance<Format>(twice);
            CHECK(measured <= stated[twice]);
            CHECK(stated[twice] <= 1.2 * measured);
        }
        for_each_depth_situation([&](const depth_situation& s) {
            if (!s.is_single() || s.truth() < 1) return;
            const auto c = Format::decode(texel_of_depth<Format>(s.casters[0].z));
            if (s.distance_behind() >= stated[0]) REQUIRE(Format::intensity(c, s.receiver) >= 0.9f);
            if (s.distance_behind() >= stated[1]) REQUIRE(Format::filtered_intensity(c, s.receiver) >= 0.9f);
        });
    });
}

TEST_CASE_TEMPLATE("percentage-closer filtering is the truth, but sees casters before the near plane from it", T, float,
                   double)
{
    for_each_depth_situation([](const depth_situation& s) {
        percentage_closer<T> state = percentage_closer_begin(T(s.receiver));
        bool before = false;
        for (const weighted_depth& c : s.casters) {
            state = percentage_closer_add(state, T(c.z), T(c.weight));
            before = before || c.z < -1;
        }
        const double intensity = double(percentage_closer_end(state));
        REQUIRE((0 <= intensity && intensity <= 1));
        if (s.receiver > -1 || !before) REQUIRE(intensity == s.truth());
    });
}

// Exact moments in double: Cantelli's and Markov's inequalities and the Fourier series without any rounding to a format.
TEST_CASE("filters with settings of one's own darken no lit surface, and stay below the truth")
{
    for_each_depth_situation([](const depth_situation& s) {
        CAPTURE(s.casters[0].z);
        CAPTURE(s.casters[0].weight);
        CAPTURE(s.receiver);
        const double z_f = double(s.receiver), truth = s.truth();
        variance_moments<double> variance{0, 0};
        exponential_moment<double> warped{0};
        exponential_variance_moments<double> both{0, 0, 0, 0};
        const exponential_settings<double> sharp{40};
        const exponential_variance_settings<double> warps{40, 5.54, 0};
        for (const weighted_depth& c : s.casters) {
            const double z = double(c.z), w = double(c.weight);
            const auto v = variance_encode(z);
            variance = {variance.mean + w * v.mean, variance.square + w * v.square};
            warped.warped += w * exponential_encode(z, sharp).warped;
            const auto e = exponential_variance_encode(z, warps);
            both = {both.positive + w * e.positive, both.positive_square + w * e.positive_square,
                    both.negative + w * e.negative, both.negative_square + w * e.negative_square};
        }
        // Roundings of moments in double: 1e-9 where the variance is not below 1e-7, which the minimum ensures.
        CHECK(variance_intensity(variance, z_f, {1e-7}) <= truth + 1e-8);
        CHECK(exponential_intensity(warped, z_f, sharp) <= truth + 1e-13);
        CHECK(exponential_variance_intensity(both, z_f, {40, 5.54, 1e-7}) <= truth + 1e-7);
        for (const int layers : {1, 2, 5}) {
            layered_variance<double> state = layered_variance_begin(z_f);
            for (int k = 0; k < layers; ++k) {
                const layered_variance_settings<double> layer{(2.0 * k + 1) / layers - 1, double(layers), 1e-7};
                variance_moments<double> b{0, 0};
                for (const weighted_depth& c : s.casters) {
                    const auto v = layered_variance_encode(double(c.z), layer);
                    b = {b.mean + double(c.weight) * v.mean, b.square + double(c.weight) * v.square};
                }
                state = layered_variance_add(state, b, layer);
            }
            CHECK(layered_variance_end(state) <= truth + 1e-8);
        }
    });
}
