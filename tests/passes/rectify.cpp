// Rectified maps against the mapping of single texels in double: one texel, 4 x 4 texels, and two depths of moments; for eyes
// outside the map, rows in every direction and both measures of depth.
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/rectify.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using view_bounds = rectified_frustum<float>;

constexpr std::size_t side = 48, columns = 70, lines = 9;

/// A light's map with blocks of depths, an eye and a frame.
struct scene {
    std::vector<float> depths;
    light_map light;
    rectified_frame frame;
    std::vector<rectified_row> rows;

    scene(bit_source& bits, double smallest_footprint, double largest_footprint)
        : depths((side + 1) * side), rows(lines)
    {
        const auto one = [&](double a, double b) { return float(bits.uniform(a, b)); };
        const auto sign = [&] { return bits.chance(0.5) ? 1.0f : -1.0f; };
        for (float& z : depths) z = bits.chance(0.2) ? 1.0f : one(-1.1, 1);
        light = {one(-20, 70), one(-20, 70), one(-0.8, 0.8), sign() * one(2, 9), sign() * one(2, 9), one(0.1, 3)};
        const double texels = std::max(std::abs(double(light.texels_x)), std::abs(double(light.texels_y)));
        const double step =
            std::exp2(bits.uniform(std::log2(smallest_footprint), std::log2(largest_footprint))) / texels;
        frame = {float(step) * columns, one(-3.14, 3.14), bits.chance(0.3) ? float(6.2831853) : one(0.01, 3),
                 bits.chance(0.5) ? rectified_depth::polar : rectified_depth::cosine};
        const float least = one(0, 1.5);
        const view_bounds bounds{frame.radius, frame.azimuth_start, frame.azimuth_length, least, least + one(0.2, 1.5)};
        rectified_rows(frame, bounds, one(0, 2), columns, rows);
    }
    [[nodiscard]] map_view<const float> map() const { return {depths, side, side, side + 1}; }

    [[nodiscard]] double step() const { return double(frame.radius) / columns; }
    [[nodiscard]] double radius(std::size_t u) const { return (double(u) + 0.5) * step(); }
    [[nodiscard]] double azimuth(std::size_t v) const
    {
        return double(frame.azimuth_start) + (double(v) + 0.5) * double(frame.azimuth_length) / lines;
    }
    [[nodiscard]] double x(std::size_t u, std::size_t v) const
    {
        return double(light.x) + radius(u) * std::cos(azimuth(v)) * double(light.texels_x);
    }
    [[nodiscard]] double y(std::size_t u, std::size_t v) const
    {
        return double(light.y) + radius(u) * std::sin(azimuth(v)) * double(light.texels_y);
    }
    [[nodiscard]] double depth(double i, double j) const
    {
        const bool inside = i >= 0 && j >= 0 && i < side && j < side;
        return inside ? double(map()(std::size_t(i), std::size_t(j))) : 1;
    }
    /// The rectified depth of an occluder at that depth of the map.
    [[nodiscard]] double mapped(std::size_t u, double depth) const
    {
        if (!(depth < 1)) return 1;
        const double z = (std::max(depth, -1.0) - double(light.z)) / double(light.depths), r = radius(u);
        const double middle = double(rows[0].range.middle), scale = double(rows[0].range.scale);
        const double at =
            frame.depth == rectified_depth::polar ? middle - std::atan2(r, z) : z / std::hypot(r, z) - middle;
        return std::clamp(at * scale, -1.0, 1.0);
    }
};

/// The distance of a place from the borders between texels.
double from_border(double x) { return std::abs(x - std::nearbyint(x)); }

double spline(double x)
{
    const double t = std::abs(x);
    return t >= 2 ? 0 : t >= 1 ? std::pow(2 - t, 3) / 6 : 2.0 / 3 - t * t + t * t * t / 2;
}

} // namespace

TEST_CASE("a texel has the rectified depth of the texel of the map that holds its light ray")
{
    bit_source bits(1);
    std::int64_t checked = 0;
    for (std::int64_t i = 0; i < effort(300); ++i) {
        const scene s(bits, 0.1, 3);
        std::vector<float> texels((columns + 3) * lines, 7.0f);
        const map_view<float> target(texels, columns, lines, columns + 3);
        rectify_depths(s.map(), s.light, s.frame, s.rows, target, {0, lines});
        for (std::size_t v = 0; v < lines; ++v) {
            for (std::size_t u = 0; u < columns; ++u) {
                const double x = s.x(u, v), y = s.y(u, v);
                if (from_border(x) < 1e-4 || from_border(y) < 1e-4) continue;
                const double tolerance = 2e-6 * double(s.rows[0].range.scale);
                REQUIRE(std::abs(double(target(u, v)) - s.mapped(u, s.depth(std::floor(x), std::floor(y)))) <=
                        tolerance);
                ++checked;
            }
            REQUIRE(texels[v * (columns + 3) + columns] == 7);
        }
        using format = moments6_unorm16;
        std::vector<format::texel> encoded(columns * lines);
        rectify<format>(s.map(), s.light, s.frame, s.rows, {encoded, columns, lines}, {0, lines});
        for (std::size_t v = 0; v < lines; ++v)
            for (std::size_t u = 0; u < columns; ++u)
                REQUIRE(encoded[v * columns + u] == texel_of_depth<format>(target(u, v)));
    }
    CHECK(checked > effort(300) * 400);
}

TEST_CASE_TEMPLATE("4 x 4 texels have the weights of a cubic B-spline", Format, moments4_float, moments6_float)
{
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(60); ++i) {
        scene s(bits, 0.05, 0.8);
        s.frame.azimuth_length = 0.01f; // so that texels are narrow across, too
        for (std::size_t v = 0; v < lines; ++v) {
            s.rows[v].cosine = float(std::cos(s.azimuth(v)));
            s.rows[v].sine = float(std::sin(s.azimuth(v)));
        }
        std::vector<format_texel<Format>> texels(columns * lines);
        rectify_filtered<Format>(s.map(), s.light, s.frame, s.rows, {texels, columns, lines}, {0, lines});
        for (std::size_t v = 0; v < lines; ++v)
            for (std::size_t u = 0; u < columns; ++u) {
                const double x = s.x(u, v), y = s.y(u, v);
                std::array<double, channel_count<Format>> mean{};
                for (double j = std::floor(y) - 3; j < y + 3; ++j)
                    for (double k = std::floor(x) - 3; k < x + 3; ++k) {
                        const double z = s.mapped(u, s.depth(k, j)), weight = spline(x - k - 0.5) * spline(y - j - 0.5);
                        const auto c =
                            gnomon_bit_cast<std::array<double, channel_count<Format>>>(Format::from_depth(z));
                        for (std::size_t n = 0; n < c.size(); ++n) mean[n] += weight * c[n];
                    }
                const auto found = load_channels<Format>(texels[v * columns + u]);
                for (std::size_t n = 0; n < found.size(); ++n) REQUIRE(std::abs(double(found[n]) - mean[n]) <= 1e-4);
            }
    }
}

// The mean over a wide texel of a map that is half one depth and half another, in stripes of two texels.
TEST_CASE("wide texels take the mean over their footprint")
{
    using format = moments4_float;
    std::vector<float> depths(256 * 256);
    for (std::size_t k = 0; k < depths.size(); ++k) depths[k] = (k / 256 + k) % 4 < 2 ? -0.5f : 0.5f;
    const light_map light{128.3f, 127.6f, 0, 1, 1, 0.01f};
    const rectified_frame frame{100, -3.1415927f, 6.2831853f, rectified_depth::polar};
    std::vector<rectified_row> rows(32);
    rectified_rows(frame, view_bounds{100, frame.azimuth_start, frame.azimuth_length, 0.5f, 2.5f}, 0, 16, rows);
    std::vector<format::texel> filtered(16 * 32), nearest(16 * 32);
    rectify_filtered<format>({depths, 256, 256}, light, frame, rows, {filtered, 16, 32}, {0, 32});
    rectify<format>({depths, 256, 256}, light, frame, rows, {nearest, 16, 32}, {0, 32});
    double off = 0, unfiltered = 0;
    for (std::size_t v = 0; v < 32; ++v)
        for (std::size_t u = 1; u < 16; ++u) {
            const float r = (float(u) + 0.5f) * 100 / 16;
            double mean = 0;
            for (const float z : {-50.0f, 50.0f})
                mean += 0.5 * double(rectified_polar_depth(polynomial_atan2(r, z), rows[0].range));
            off += std::pow(double(filtered[v * 16 + u][0]) - mean, 2);
            unfiltered += std::pow(double(nearest[v * 16 + u][0]) - mean, 2);
        }
    CHECK(off < 0.4 * unfiltered); // 0.23, if texels were independent
}

TEST_CASE_TEMPLATE("two depths under the sample of a map of moments are mapped and mixed", Source, moments4_unorm16,
                   moments4_half, moments4_float)
{
    using format = moments6_float;
    bit_source bits(3);
    const double noise = double(stored_noise<Source>.least_variance);
    for (std::int64_t i = 0; i < effort(300); ++i) {
        scene s(bits, 0.1, 0.8);
        s.frame.azimuth_length = 0.01f;
        s.frame.radius = columns * float(bits.uniform(0.05, 0.19)); // less than a texel for a texel: no mip level
        s.light.x = s.light.y = -20;
        for (rectified_row& r : s.rows) r.cosine = r.sine = float(std::sqrt(0.5));
        s.light.texels_x = s.light.texels_y = 5;
        s.light.z = -2; // so that errors of depth are not magnified
        s.light.depths = 1;
        // Stripes of two depths, between which a bilinear sample mixes.
        const float a = float(bits.uniform(-0.9, -0.1)), b = float(bits.uniform(0.1, 0.9));
        std::vector<format_texel<Source>> source(mip_texels(side, side));
        const mip_view<format_texel<Source>> mips{source, side, side};
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = 0; x < side; ++x) mips.level(0)(x, y) = texel_of_depth<Source>(x % 2 ? a : b);
        build_mips<Source>(mips);
        std::vector<format::texel> texels(columns * lines);
        rectify_moments<format, Source>(mips, s.light, s.frame, s.rows, {texels, columns, lines}, {0, lines});
        for (std::size_t u = 0; u < columns; ++u) {
            const double x = -20 + s.radius(u) * std::sqrt(0.5) * 5 - 0.5;
            if (!(x > 0 && x < side - 1)) continue;
            const double between = x - std::floor(x), to_a = std::size_t(x) % 2 ? 1 - between : between;
            const auto ca = gnomon_bit_cast<std::array<double, 6>>(format::from_depth(s.mapped(u, double(a))));
            const auto cb = gnomon_bit_cast<std::array<double, 6>>(format::from_depth(s.mapped(u, double(b))));
            // One depth, if the share of the other is noise; else both, off by noise over their variance.
            const double variance = between * (1 - between) * std::pow(double(b - a), 2);
            const double tolerance = 5e-4 + 60 * noise * double(s.rows[0].range.scale) / (variance + 30 * noise);
            const auto found = load_channels<format>(texels[u]);
            for (std::size_t n = 0; n < 6; ++n)
                REQUIRE(std::abs(double(found[n]) - (to_a * ca[n] + (1 - to_a) * cb[n])) <= tolerance);
        }
    }
}

TEST_CASE("bands of rows give the map of one pass")
{
    using format = moments6_unorm10;
    bit_source bits(5);
    const scene s(bits, 0.5, 2);
    std::vector<format::texel> whole(columns * lines), banded(columns * lines);
    rectify_filtered<format>(s.map(), s.light, s.frame, s.rows, {whole, columns, lines}, {0, lines});
    for (const row_range band : {row_range{6, 9}, {0, 1}, {1, 1}, {1, 6}})
        rectify_filtered<format>(s.map(), s.light, s.frame, s.rows, {banded, columns, lines}, band);
    CHECK(whole == banded);
}
