// Layered maps of rectangles in motion against what these cover, against plain maps, and against each other.
#include "layered_quads.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Mean of numbers, and the standard error of the mean.
struct mean_of {
    double sum = 0, squares = 0, count = 0;
    void add(double x) { sum += x, squares += x * x, ++count; }
    double mean() const { return sum / count; }
    double error() const { return std::sqrt((squares / count - mean() * mean()) / (count - 1)); }
};

const layer_settings quality{}, speed{8, 16, 16};

} // namespace

TEST_CASE_TEMPLATE("the mean over receiver times is the covered time", Format, layer_variance_float,
                   layer_variance_half, layer_moments4_float, layer_exponential_float)
{
    bit_source bits(1);
    for (const layer_settings& settings : {quality, speed})
        for (const moving_quad& quad : {moving_quad{32, 32, 6, 9, -0.2f, 60, 0, 0.05f},
                                        {32, 32, 6, 9, -0.2f, 0, 72, 0},
                                        {32, 32, 6, 9, -0.2f, 54, 27, -0.3f}}) {
            const quad_scene scene{{0.8f, 0}, {quad}};
            mean_of difference;
            for (std::int64_t seed = 0; seed < 16; ++seed) {
                const auto samples = sample_quads(scene, 64, 64, 4, bits);
                const layers_of<Format> layers(samples, settings);
                double sum = 0;
                for (int k = 0; k < 256; ++k) { // places that both ends of the rectangle pass, far from its sides
                    const float t = (float(k) + float(bits.uniform(0, 1))) / 256;
                    const float x = float(bits.uniform(30, 34)), y = float(bits.uniform(30, 34));
                    sum += double(layers.intensity(still_receiver(x, y, 0.7f, t, bits))) -
                           double(scene.is_covered(x, y, t, 0.7f));
                }
                difference.add(sum / 256);
            }
            INFO(Format::id << " " << quad.d_x << ": " << difference.mean() << " +- " << difference.error());
            CHECK(std::abs(difference.mean()) < 4 * difference.error());
            CHECK(difference.error() < 0.01);
        }
}

TEST_CASE("sums that are evened out are less biased where motion is not much longer than the window")
{
    bit_source bits(6);
    const quad_scene scene{{0.8f, 0}, {{32, 32, 6, 9, -0.2f, 20, 0, 0}}};
    for (layer_settings settings : {quality, speed}) {
        double bias[2] = {};
        for (int seed = 0; seed < 24; ++seed) {
            const auto samples = sample_quads(scene, 64, 64, 4, bits);
            for (const bool even : {false, true}) {
                settings.even = even;
                const layers_of<layer_variance_float> layers(samples, settings);
                for (int k = 0; k < 256; ++k) {
                    const float t = (float(k) + float(bits.uniform(0, 1))) / 256;
                    const float x = float(bits.uniform(30, 34)), y = float(bits.uniform(30, 34));
                    bias[even] += double(layers.intensity(still_receiver(x, y, 0.7f, t, bits))) -
                                  double(scene.is_covered(x, y, t, 0.7f));
                }
            }
        }
        INFO("bias " << bias[0] / 24 / 256 << ", evened out " << bias[1] / 24 / 256);
        CHECK(std::abs(bias[1]) < 0.75 * std::abs(bias[0]));
    }
}

TEST_CASE("without motion, with one layer and a texel per texel, layers are the plain map")
{
    bit_source bits(2);
    layer_settings settings{4, 8, 8, 1};
    // Depths at random, so that no receiver is before or behind all of a window, which only layers know.
    auto samples = sample_quads({{0, 0}, {}}, 45, 50, 4, bits);
    for (auto& s : samples.of) s.z = float(bits.uniform(-0.9, 0.9));
    const layers_of<layer_variance_float> plain(samples, settings);
    CHECK(plain.counts.layers == 0);
    CHECK(plain.counts.blocks == 4);
    for (auto& s : samples.of) s.d_x = 1e-9f; // too short for a direction
    const layers_of<layer_variance_float> layers(samples, settings);
    CHECK(layers.counts.layers == layers.clusters.size());
    CHECK(layers.counts.blocks == 0);
    double worst = 0, shadows = 0;
    for (int i = 0; i < 4000; ++i) {
        layer_receiver<float> r = still_receiver(float(bits.uniform(0, 45)), float(bits.uniform(0, 50)),
                                                 float(bits.uniform(-0.5, 0.5)), 0.5f, bits);
        r.x0 -= float(bits.uniform(0, 1.5)), r.x1 += float(bits.uniform(0, 1.5)), r.cross_y = float(bits.uniform(0, 2));
        const layer_look_up own{layer_tiles::own};
        const double a = double(plain.intensity(r, own)), b = double(layers.intensity(r, own));
        worst = std::max(worst, std::abs(a - b));
        shadows += a;
    }
    CHECK(shadows > 300);
    CHECK(worst < 2e-4); // roundings of sums of depths that are stretched, and of those that are not
}

TEST_CASE("a moving receiver keeps the stripe that a crossing rectangle draws on it")
{
    bit_source bits(3);
    const quad_scene scene{{0.9f, 0}, {{48, 48, 40, 4, -0.5f, 0, 60, 0}, {48, 48, 4, 40, 0.2f, 60, 0, 0}}};
    for (const layer_settings& settings : {quality, speed}) {
        const layers_of<layer_variance_float> layers(sample_quads(scene, 96, 96, 4, bits), settings);
        double layered = 0, deep = 0, count = 0;
        for (int i = 0; i < 3000; ++i) {
            const float t = float(bits.uniform(0.1, 0.9)), along = float(bits.uniform(-25, 25));
            const float x = 48 + 60 * (t - 0.5f) + float(bits.uniform(-3, 3)), y = 48 + along;
            const layer_receiver<float> r = still_receiver(x, y, 0.1f, t, bits);
            double open = 0, mean = 0;
            for (int k = 0; k < 64; ++k) {
                const float at = (float(k) + 0.5f) / 64;
                mean += scene.is_covered(x, y, at, 0.1f) ? 1.0 / 64 : 0;
                open += scene.is_covered(x, y, r.t0 + at * (r.t1 - r.t0), 0.1f) ? 1.0 / 64 : 0;
            }
            layered += std::pow(double(layers.intensity(r)) - open, 2), deep += std::pow(mean - open, 2), ++count;
        }
        INFO("rms of layers " << std::sqrt(layered / count) << ", without times " << std::sqrt(deep / count));
        CHECK(layered < 0.25 * deep);
    }
}

TEST_CASE("blended tiles have no larger steps across their borders than within")
{
    bit_source bits(4);
    // Motions that differ from tile to tile, so that grids turn.
    const auto turning = [&] {
        auto samples = sample_quads({{0.8f, 0}, {{40, 40, 22, 22, -0.3f, 0, 0, 0}}}, 80, 80, 4, bits);
        for (auto& s : samples.of)
            if (s.id == 0) s.d_x = 0.5f * (s.y - 40), s.d_y = -0.5f * (s.x - 40);
        return samples;
    };
    for (const layer_settings& settings : {quality, speed}) {
        const auto rms_of_steps = [&](layer_tiles tiles, float from_border) {
            mean_of squares;
            for (int seed = 0; seed < 4; ++seed) {
                const layers_of<layer_variance_float> layers(turning(), settings);
                for (int i = 0; i < 1500; ++i) {
                    const float tile = float(settings.tile),
                                border = tile * float(3 + bits.below(std::size_t(74 / tile) - 4));
                    const float at = border + from_border * tile, along = float(bits.uniform(12, 68));
                    const float t = float(bits.uniform(0, 1));
                    auto a = still_receiver(at - 0.05f, along, 0.7f, t, bits), b = a;
                    b.x += 0.1f, b.x0 += 0.1f, b.x1 += 0.1f;
                    squares.add(
                        std::pow(double(layers.intensity(b, {tiles})) - double(layers.intensity(a, {tiles})), 2));
                }
            }
            return std::sqrt(squares.mean());
        };
        const double within = rms_of_steps(layer_tiles::blended, 0.5f), across = rms_of_steps(layer_tiles::blended, 0);
        const double own = rms_of_steps(layer_tiles::own, 0);
        INFO("within " << within << ", across " << across << ", across own tiles " << own);
        CHECK(across < 1.25 * within);
        CHECK(own > 2 * within); // there is something to blend
    }
}

TEST_CASE("a look-up passes all layers of a tile, those that are transparent there, too")
{
    bit_source bits(7);
    const moving_quad narrow{14, 24, 10, 30, -0.4f, 1e-3f, 0, 0}, wide{24, 24, 20, 30, 0.2f, 1e-3f, 0, 0};
    const layers_of<layer_variance_float> layers(sample_quads({{0.8f, 0}, {narrow, wide}}, 48, 48, 4, bits), {});
    for (int k = 0; k < 300; ++k) { // in the tile beside the edge of the nearer rectangle
        const auto at = [&](float x, float z) {
            return layers.intensity(still_receiver(x, float(bits.uniform(8, 40)), z, 0.5f, bits), {layer_tiles::own});
        };
        const float x = float(bits.uniform(25.5, 28));
        REQUIRE(at(x, 0.7f) > 0.999f);
        REQUIRE(at(x, -0.1f) < 0.001f);
        REQUIRE(at(float(bits.uniform(12, 20)), -0.1f) > 0.999f);
    }
}

TEST_CASE("fast layers are blurred across their motion, and keep their opacity")
{
    bit_source bits(10);
    const quad_scene scene{{0.8f, 0}, {{32, 32, 90, 3, -0.5f, 100, 0, 0}}};
    const auto samples = sample_quads(scene, 64, 64, 16, bits);
    layer_settings settings;
    double inside[2] = {}, beside[2] = {}, sum[2] = {};
    for (const bool smooth : {false, true}) {
        settings.smooth_streaks = smooth;
        const layers_of<layer_variance_float> layers(samples, settings);
        for (int k = 0; k < 3200; ++k) {
            const float y = 24 + float(k) / 200, x = float(bits.uniform(20, 44));
            const double shadow = double(
                layers.intensity(still_receiver(x, y, 0.5f, float(bits.uniform(0.2, 0.8)), bits), {layer_tiles::own}));
            sum[smooth] += shadow;
            if (std::abs(y - 32) < 1) inside[smooth] += shadow / 400;
            if (std::abs(std::abs(y - 32) - 5) < 0.5f) beside[smooth] += shadow / 400;
        }
    }
    INFO("sums " << sum[0] << ", " << sum[1] << "; inside " << inside[0] << ", " << inside[1] << "; beside "
                 << beside[0] << ", " << beside[1]);
    CHECK(sum[1] == doctest::Approx(sum[0]).epsilon(0.02));
    CHECK(beside[1] > beside[0] + 0.01);
    CHECK(inside[1] < inside[0] - 0.01);
}

TEST_CASE("layers and blocks are stored only where samples need them")
{
    bit_source bits(5);
    using layers = layers_of<layer_variance_float>;
    const auto counts = [&](const quad_scene& scene, float floor_id) {
        auto samples = sample_quads(scene, 96, 64, 2, bits);
        for (auto& s : samples.of)
            if (s.id == float(scene.quads.size())) s.id = floor_id;
        return layers(samples, quality).counts;
    };
    const flat_floor floor{0.8f, 0};
    const moving_quad quad{20, 20, 6, 6, -0.2f, 8, 0, 0};
    CHECK(counts({floor, {}}, -1).layers == 0); // background alone
    CHECK(counts({floor, {}}, -1).blocks == 0);
    CHECK(counts({floor, {}}, 7).layers == 0); // one static surface
    CHECK(counts({floor, {}}, 7).blocks == 6);
    const auto one = counts({floor, {quad}}, -1);
    CHECK(one.blocks == 0);
    CHECK(one.layers > 20);
    CHECK(one.layers < 7 * 7 + 1); // windows of 12 that meet a rectangle of 12 + 8 by 12
    const auto two = counts({floor, {quad}}, 7);
    CHECK(two.layers == 2 * one.layers);
    CHECK(two.blocks == 6);
    const auto four = counts({floor, {quad, {20, 20, 6, 6, 0.1f, 8, 0, 0}, {20, 20, 6, 6, 0.4f, 8, 0, 0}}}, 7);
    CHECK(double(four.layers) < 1.2 * double(two.layers)); // what no sample sees forms no layer
}

/// The mean shadow that is left on a plane whose bias covers half a texel of a layer along its motion. The mean place of the
/// samples that a filter reads is off the receiver by a normal distance of variance `of_mean`, in square texels of the layer;
/// the samples vary by `within` around it. Where it is beyond the bias by e, Cantelli's bound is at most e^2 / within. The
/// mean of that over all distances is in closed form.
double left_on_plane(double of_mean, double within)
{
    const double k = 0.5 / std::sqrt(of_mean), pi = std::acos(-1.0);
    const double tail = std::erfc(k / std::sqrt(2)) / 2, density = std::exp(-k * k / 2) / std::sqrt(2 * pi);
    return of_mean / within * ((1 + k * k) * tail - k * density);
}

TEST_CASE_TEMPLATE("tilted surfaces in motion do not shadow themselves", Format, layer_variance_float,
                   layer_variance_half, layer_exponential_float)
{
    // A texel has at least the four samples of one texel of the light's map, at random places, of variance 1/12. Halfway
    // between two texels a filter counts both by 1/2, and their numbers vary.
    const double by_one_probe = left_on_plane((1.0 / 8 + 1.0 / 24) / 4, 1.0 / 12 + 1.0 / 6);
    // Fast surfaces have footprints of a quarter of the layer, up to 4 texels: three whole ones and two halves, whose
    // numbers vary at distances of 1 and 2.
    const double by_footprint =
        left_on_plane((2 * (4.0 / 64 + 1.0 / 16) + 7.0 / 32 / 12) / 4, 16.0 / 12 + 1.0 / 12 + 1.0 / 6);
    bit_source bits(7);
    const layer_look_up look_up{.limit = 0.25f}; // above most of the biases of this slope
    const float slope = 0.01f;
    for (const layer_settings& settings : {quality, speed})
        for (const float d : {0.0f, 1.0f, 12.0f, 60.0f, 200.0f}) {
            mean_of acne, without_bias;
            for (const float across : {0.0f, 0.5f, -1.0f}) {
                auto samples = sample_quads({{0, 0}, {}}, 64, 64, 4, bits);
                for (auto& s : samples.of) s.z = slope * (s.x - 32 - d * (s.t - 0.5f)), s.d_x = d, s.d_y = across * d;
                const layers_of<Format> layers(samples, settings);
                for (int i = 0; i < 4000; ++i) {
                    const float x = float(bits.uniform(8, 56)), t = float(bits.uniform(0, 1));
                    const float z = slope * (x - 32 - d * (t - 0.5f));
                    auto r = still_receiver(x, float(bits.uniform(8, 56)), z, t, bits);
                    if (!(std::abs(z) < 1)) continue;
                    without_bias.add(double(layers.intensity(r, look_up)));
                    r.slope = slope;
                    acne.add(double(layers.intensity(r, look_up)));
                }
            }
            INFO(Format::id << " " << d << ": acne " << acne.mean() << ", without bias " << without_bias.mean());
            CHECK(acne.mean() < std::max(by_one_probe, by_footprint));
            CHECK(without_bias.mean() > 4 * acne.mean());
        }
}

TEST_CASE("casters that are farther away than the limit of a bias shadow planes of any slope in layers of any motion")
{
    bit_source bits(8);
    const layer_look_up usual, unlimited{.limit = 2};
    for (const layer_settings& settings : {quality, speed})
        for (const float d : {0.0f, 12.0f, 200.0f}) {
            auto samples = sample_quads({{0, 0}, {}}, 64, 64, 4, bits);
            for (auto& s : samples.of) s.d_x = d;
            const layers_of<layer_variance_float> layers(samples, settings);
            for (int i = 0; i < 200; ++i) {
                auto r = still_receiver(float(bits.uniform(8, 56)), float(bits.uniform(8, 56)), 2 * usual.limit,
                                        float(bits.uniform(0, 1)), bits);
                r.slope = float(std::exp2(bits.uniform(0, 20)));
                REQUIRE(layers.intensity(r, usual) > 0.99f);
                REQUIRE(layers.intensity(r, unlimited) == 0);
            }
        }
}
