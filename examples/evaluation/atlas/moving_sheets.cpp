#include "moving_sheets.hpp"

#include <gnomon/filters/percentage_closer.h>
#include <gnomon/passes/layers/layer_accumulate.hpp>
#include <gnomon/passes/layers/layer_cluster.hpp>
#include <gnomon/passes/layers/layer_look_up.hpp>
#include <gnomon/storage/layer_formats.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>

namespace gnomon::evaluation {

namespace {

constexpr double behind = 0.95; // depth of receivers
constexpr int camera_samples = 4;
constexpr double reach = 8; // of pixels, from the middle of the map, in the middle of the shutter interval

struct seen_sheet {
    bool covered;
    double d_x, d_y;
};

// A sheet with the sine and cosine of its direction.
struct turned_sheet : moving_sheet {
    explicit turned_sheet(const moving_sheet& s) : moving_sheet(s), c(std::cos(s.direction)), n(std::sin(s.direction))
    {}

    // The sheet at (x, y), from the middle of the map, at time t: true if it covers that place, and the motion of its point there.
    seen_sheet at(double x, double y, double t) const
    {
        const double along = x * c + y * n, aside = y * c - x * n, passed = t - 0.5;
        double from = along - speed * passed, d_along = speed, d_aside = 0; // the place at time 1/2, and the motion
        if (turn > 0) {
            const double r = aside + distance, cosine = std::cos(turn * passed), sine = std::sin(turn * passed);
            const double chord = 2 * std::sin(turn / 2);
            from = along * cosine - r * sine;
            d_along = chord * (along * sine + r * cosine), d_aside = -chord * from;
        }
        const double place = from / period;
        return {(place - std::floor(place)) * period < stripe, d_along * c - d_aside * n, d_along * n + d_aside * c};
    }

    double c, n;
};

using turned_sheets = std::vector<turned_sheet>;

// The side of a map that holds the paths of all pixels, and windows around them.
std::size_t extent_for(const turned_sheet& followed)
{
    double longest = 0;
    for (const double x : {-reach, reach})
        for (const double y : {-reach, reach}) {
            const seen_sheet at = followed.at(x, y, 0.5);
            longest = std::max({longest, std::abs(at.d_x), std::abs(at.d_y)});
        }
    return 16 * std::size_t(std::ceil((2 * reach + longest + 16) / 16));
}

std::vector<stochastic_sample<float>> samples_of(const turned_sheets& sheets, std::size_t extent, int samples)
{
    const double middle = 0.5 * double(extent);
    std::mt19937 random(1);
    const auto number = [&] { return float(random() >> 8) * 0x1p-24f; };
    std::vector<stochastic_sample<float>> result;
    for (std::size_t i = 0; i < extent * extent; ++i)
        for (int k = 0; k < samples; ++k) {
            const float x = float(i % extent) + number(), y = float(i / extent) + number();
            const float t = stratified_time(float(k), float(samples), number());
            auto seen = stochastic_background(x, y, t);
            for (std::size_t id = 0; id < sheets.size(); ++id) {
                const turned_sheet& s = sheets[id];
                const auto z = float(s.depth);
                const seen_sheet at = s.at(double(x) - middle, double(y) - middle, double(t));
                if (!at.covered || !(z < seen.z)) continue;
                seen = {x, y, t, z, float(at.d_x), float(at.d_y), 0, float(id)};
            }
            result.push_back(seen);
        }
    return result;
}

using format = layer_variance_float;

sheet_visibility layered(const sample_map<float>& samples, const layer_settings& how)
{
    struct memory {
        std::vector<tile_clusters> clusters;
        std::vector<std::uint32_t> first, blocks;
        std::vector<layer_grid<float>> grids;
        std::vector<format_texel<format>> texels, plain;
        layer_map<format_texel<format>> map;
    };
    const auto all = std::make_shared<memory>();
    const std::size_t extent = samples.width;
    const std::size_t tiles = tiles_along(extent, how.tile), blocks = tiles_along(extent, layer_block);
    all->clusters.resize(tiles * tiles), all->first.resize(tiles * tiles + 1), all->blocks.resize(blocks * blocks);
    layer_cluster(samples, how, all->clusters, {0, tiles});
    const layer_counts counts = layer_allocate(how, all->clusters, extent, extent, all->first, all->blocks);
    all->grids.resize(counts.layers), all->texels.resize(counts.layers * layer_texels(how));
    all->plain.resize(counts.blocks * block_texels(how));
    all->map = {extent, extent, how, all->first, all->blocks, all->grids, all->texels, all->plain};
    layer_accumulate<format>(samples, all->clusters, all->map, {0, tiles});
    layer_mips<format>(all->map, {0, tiles});
    return [all](const sheet_receiver& at) {
        // The world point is held for the part of the time that a sample of the camera stands for.
        const double half = 0.5 / camera_samples, t0 = std::max(at.t - half, 0.0), t1 = std::min(at.t + half, 1.0);
        const auto x = [&](double t) { return float(at.x + at.motion_x * (t - at.t)); };
        const auto y = [&](double t) { return float(at.y + at.motion_y * (t - at.t)); };
        const layer_receiver<float> r{float(at.x), float(at.y), float(behind),
                                      float(at.t), x(t0),       y(t0),
                                      float(t0),   x(t1),       y(t1),
                                      float(t1),   0,           1,
                                      0,           0,           0};
        return 1 - double(layer_intensity<format>(all->map, r, {.tiles = layer_tiles::blended}));
    };
}

// The samples of the slice of the receiver's time, by bilinear weights of the nearest texels.
sheet_visibility sliced(const sample_map<float>& samples)
{
    return [samples](const sheet_receiver& at) {
        const auto slice = std::size_t(slice_of(float(at.t), float(samples.samples)));
        const double x = at.x - 0.5, y = at.y - 0.5;
        auto state = percentage_closer_begin(float(behind));
        for (const int j : {0, 1})
            for (const int i : {0, 1}) {
                const double column = std::floor(x) + i, row = std::floor(y) + j;
                const double weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
                state = percentage_closer_add(state, samples(std::size_t(column), std::size_t(row))[slice].z,
                                              float(weight));
            }
        return 1 - double(percentage_closer_end(state));
    };
}

} // namespace

sheet_method layers_with(std::string id, std::string label, const layer_settings& how)
{
    return {std::move(id), std::move(label), [how](const sample_map<float>& samples) { return layered(samples, how); }};
}

sheet_method time_dependent_sheets() { return {"time_dependent", "time-dependent", sliced}; }

std::vector<sheet_method> sheet_methods()
{
    return {layers_with("layers_quality", "layers, for quality", {.tile = 4, .guard = 12, .texels = 8}),
            layers_with("layers_speed", "layers, for speed", {.tile = 8, .guard = 16, .texels = 16}),
            time_dependent_sheets()};
}

double error_behind(const std::vector<moving_sheet>& sheets, int samples, const sheet_method& by)
{
    const turned_sheets turned(sheets.begin(), sheets.end());
    const std::size_t extent = extent_for(turned.front());
    const double middle = 0.5 * double(extent);
    const std::vector<stochastic_sample<float>> all = samples_of(turned, extent, samples);
    const sheet_visibility visibility = by.map_of({extent, extent, std::size_t(samples), all});
    std::mt19937 random(2);
    const auto number = [&] { return double(random() >> 8) * 0x1p-24; };
    const auto sees = [&](double x, double y, double t) {
        for (const turned_sheet& s : turned)
            if (s.at(x - middle, y - middle, t).covered) return 0;
        return 1;
    };
    constexpr int across = 10, times = 24, places = 2;
    double squares = 0;
    for (const bool follows : {false, true})
        for (int i = 0; i < across * across; ++i) {
            const double x = middle - reach + 2 * reach * (i % across + 0.5) / across,
                         y = middle - reach + 2 * reach * (i / across + 0.5) / across;
            const seen_sheet point = turned.front().at(x - middle, y - middle, 0.5);
            const double c = follows ? point.d_x : 0, n = follows ? point.d_y : 0;
            double exact = 0, found = 0;
            for (int k = 0; k < times; ++k)
                for (int p = 0; p < places * places; ++p) {
                    const double t = (k + 0.5) / times, u = (p % places + 0.5) / places - 0.5,
                                 v = (p / places + 0.5) / places - 0.5;
                    exact += sees(x + u + c * (t - 0.5), y + v + n * (t - 0.5), t);
                }
            exact /= times * places * places;
            for (int k = 0; k < camera_samples; ++k) {
                const double t = (k + number()) / camera_samples, u = number() - 0.5, v = number() - 0.5;
                found += visibility({x + u + c * (t - 0.5), y + v + n * (t - 0.5), t, c, n}) / camera_samples;
            }
            squares += (found - exact) * (found - exact);
        }
    return std::sqrt(squares / (2 * across * across));
}

} // namespace gnomon::evaluation
