#include "moving_samples.hpp"

#include "tile_bins.hpp"

#include <gnomon/motion/triangle/triangle_motion.h>
#include <gnomon/passes/range/samples.hpp>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace gnomon::renderer {

namespace {

// The finalizer of SplitMix64.
std::uint64_t mixed(std::uint64_t bits)
{
    bits += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

// A number in [0, 1) of 20 bits, from bit `first` on.
float jitter(std::uint64_t bits, int first) { return float(bits >> first & 0xfffffu) * 0x1p-20f; }

struct sample_place {
    float x, y, t; // in the texel, and time
};

// The places and times of the samples of a texel.
class sample_source {
  public:
    explicit sample_source(const sample_options& how) : how_(how), count_(float(how.samples)), stratum_(1 / count_)
    {
        if (how.samples < 1 || how.samples > int(texel_limit))
            throw std::invalid_argument(
                fmt::format("moving samples: {} samples, 1 to {} are possible", how.samples, int(texel_limit)));
        if (strata()) draw_strata();
    }

    // Calls put(k, place) for the samples of a texel.
    template <class Put> void operator()(const glm::ivec2& texel, const Put& put) const
    {
        const std::uint64_t own =
            mixed(std::uint64_t(how_.seed) << 32 | std::uint64_t(texel.y) << 16 | std::uint64_t(texel.x));
        const std::size_t samples = std::size_t(how_.samples), strata_begin = (own >> 56) * samples;
        const float shifted = instant_of_texel(std::size_t(texel.x), std::size_t(texel.y)) + shift_;
        for (std::size_t k = 0; k < samples; ++k) {
            const std::uint64_t bits = mixed(own + k);
            const bool even = how_.pattern == sample_pattern::even;
            const float part = even ? shifted - std::floor(shifted) : jitter(bits, 0);
            sample_place at{0.5f, 0.5f, stratified_time(float(k), count_, part)};
            if (how_.pattern != sample_pattern::centres) at.x = jitter(bits, 20), at.y = jitter(bits, 40);
            if (strata()) {
                at.x = (float(strata_[strata_begin + k].x) + at.x) * stratum_;
                at.y = (float(strata_[strata_begin + k].y) + at.y) * stratum_;
            }
            put(k, at);
        }
    }

  private:
    static constexpr int patterns = 256;

    bool strata() const { return how_.pattern == sample_pattern::stratified || how_.pattern == sample_pattern::even; }

    // Draws the columns and rows of the samples, for each pattern.
    void draw_strata()
    {
        std::uint64_t state = 0;
        const auto shuffled = [&](int count) {
            std::vector<int> order(std::size_t(count), 0);
            std::iota(order.begin(), order.end(), 0);
            for (int i = count; i > 1; --i)
                std::swap(order[std::size_t(i - 1)], order[(mixed(state++) >> 32) * std::uint64_t(i) >> 32]);
            return order;
        };
        int columns = int(std::sqrt(double(how_.samples)));
        while (how_.samples % columns != 0) --columns;
        const int rows = how_.samples / columns;
        for (int p = 0; p < patterns; ++p) {
            const std::vector<int> across = shuffled(rows), down = shuffled(columns);
            for (const int cell : shuffled(how_.samples)) {
                const int i = cell % columns, j = cell / columns;
                strata_.emplace_back(i * rows + across[std::size_t(j)], j * columns + down[std::size_t(i)]);
            }
        }
    }

    const sample_options how_;
    const float count_, stratum_;
    const float shift_ = jitter(mixed(how_.seed), 0); // of the parts of all texels
    std::vector<glm::ivec2> strata_;                  // sample k of pattern p is number p samples + k
};

// One sample of each texel of a pack, with the nearest triangle so far.
struct sample_pack {
    texel_pack x, y, t; // from the middle of the tile
    texel_pack z, triangle;
};

constexpr float none = -1;

// The lanes that a side of a triangle covers at their times. Most triangles are outside of an edge in all lanes. Out of
// line, so that compilers do not fill the stack with the coefficients of edges that are not needed.
[[gnu::noinline]] auto covered(const triangle_setup<float>& edges, bool linear, float facing, const sample_pack& s)
{
    const auto inside = [&](const edge_equation<float>& edge) {
        const moving_edge<texel_pack> e =
            linear ? linear_edge_at(broadcast(edge), s.x, s.y) : edge_equation_at(broadcast(edge), s.x, s.y);
        return texel_pack(0.f) <= texel_pack(facing) * moving_edge_at(e, s.t);
    };
    auto lanes = inside(edges.a);
    if (gnomon_any(lanes)) lanes = lanes && inside(edges.b);
    if (gnomon_any(lanes)) lanes = lanes && inside(edges.c);
    return lanes;
}

// Puts a side of a triangle into the samples that see it, in front of what they have seen so far.
void put(const tile_triangle& triangle, const triangle_setup<float>& edges, float facing, float number,
         moving_samples& at, std::span<sample_pack> samples)
{
    const moving_setup& setup = triangle.setup();
    for (sample_pack& s : samples) {
        if (!gnomon_any(texel_pack(setup.nearest) < s.z)) continue;
        const auto seen = covered(edges, setup.linear, facing, s);
        if (!gnomon_any(seen)) continue;
        at.x = s.x, at.y = s.y;
        const texel_pack z =
            setup.linear ? triangle.linear(at, facing).depth(s.t) : triangle.quadratic(at, facing).depth(s.t);
        const auto nearer = seen && texel_pack(-1.f) < z && z < s.z;
        s.z = gnomon_select(nearer, z, s.z);
        s.triangle = gnomon_select(nearer, texel_pack(number), s.triangle);
    }
}

struct seen_lanes {
    texel_lanes d_x, d_y, d_z, z, id;
};

// The seen points of a pack: one triangle after the other, in all lanes that see it.
seen_lanes seen(const tile_bins& bins, const glm::dvec2& middle, const sample_pack& s)
{
    texel_pack d_x(0.f), d_y(0.f), d_z(0.f), id(static_cast<float>(stochastic_nothing));
    texel_lanes triangles;
    s.triangle.store_unaligned(triangles.data());
    for (std::uint64_t left = bits_of(texel_pack(0.f) <= s.triangle); left != 0;) {
        const float index = triangles[std::size_t(std::countr_zero(left))];
        const tile_triangle& triangle = bins[std::size_t(index)];
        const moving_setup& setup = triangle.setup();
        const auto corner = [&](const moving_vertex<double>& v) {
            return rounded_to<texel_pack>(moving_vertex_translate(v, middle.x, middle.y));
        };
        const moving_triangle<texel_pack> corners{corner(setup.corners.a), corner(setup.corners.b),
                                                  corner(setup.corners.c)};
        const moving_edges<texel_pack> edges = triangle_setup_edges(broadcast(triangle.exact()), s.x, s.y);
        const triangle_motion<texel_pack> d = moving_triangle_motion(corners, edges, s.t, texel_pack(0.f));
        const auto here = s.triangle == texel_pack(index);
        d_x = gnomon_select(here, d.d_x, d_x);
        d_y = gnomon_select(here, d.d_y, d_y);
        d_z = gnomon_select(here, d.d_z, d_z);
        id = gnomon_select(here, texel_pack(float(setup.number)), id);
        left &= ~bits_of(here);
    }
    seen_lanes result;
    d_x.store_unaligned(result.d_x.data()), d_y.store_unaligned(result.d_y.data());
    d_z.store_unaligned(result.d_z.data()), id.store_unaligned(result.id.data());
    s.z.store_unaligned(result.z.data());
    return result;
}

struct scratch {
    tile_bins bins{true};
    std::vector<sample_pack> packs;
    std::vector<sample_place> places; // of the picture, lane by lane
};

void rasterize_tile(const tiled_triangles& scenery, std::size_t number, const sample_source& source, scratch& own,
                    sample_picture& to)
{
    const moving_tile tile = scenery.tile(number);
    const glm::vec2 middle = glm::vec2(tile.corner) + 0.5f * float(moving_tile_size);
    const auto count = std::size_t(to.samples);
    own.bins.assign(scenery, number);
    own.packs.resize(count);
    own.places.resize(count * texel_pack::size);
    for (std::size_t i = 0; i < moving_samples::packs_per_tile; ++i) {
        moving_samples at(i);
        if (glm::any(glm::greaterThanEqual(moving_block_size * at.block, tile.size))) continue;
        for (std::size_t lane = 0; lane < texel_pack::size; ++lane) {
            const glm::ivec2 texel = tile.corner + at.place(lane);
            source(texel, [&](std::size_t k, sample_place place) {
                // Rounding may not move a place into the next texel: the number below that one is the most.
                constexpr float below = 1 - 0x1p-24f;
                const glm::vec2 low(texel);
                place.x = std::min(low.x + place.x, (low.x + 1) * below);
                place.y = std::min(low.y + place.y, (low.y + 1) * below);
                own.places[k * texel_pack::size + lane] = place;
            });
        }
        for (std::size_t k = 0; k < count; ++k) {
            const sample_place* lanes = &own.places[k * texel_pack::size];
            texel_lanes x, y, t;
            for (std::size_t lane = 0; lane < texel_pack::size; ++lane)
                x[lane] = lanes[lane].x - middle.x, y[lane] = lanes[lane].y - middle.y, t[lane] = lanes[lane].t;
            own.packs[k] = {texel_pack::load_unaligned(x.data()), texel_pack::load_unaligned(y.data()),
                            texel_pack::load_unaligned(t.data()), texel_pack(1.f), texel_pack(none)};
        }
        const std::size_t block = i / moving_samples::packs_per_block;
        own.bins.for_each(block, [&](const tile_triangle& triangle) {
            const std::size_t index = own.bins.index_of(triangle);
            const linear_interval<float> times = own.bins.times(index, block);
            const auto stratum = [&](float t) { return std::size_t(slice_of(t, float(count))); };
            const std::size_t first = stratum(times.begin), last = stratum(times.end);
            const std::span samples = std::span(own.packs).subspan(first, last - first + 1);
            const moving_setup& setup = triangle.setup();
            if (setup.positive) put(triangle, triangle.positive(), 1, float(index), at, samples);
            if (setup.negative) put(triangle, triangle.negative(), -1, float(index), at, samples);
        });
        for (std::size_t k = 0; k < count; ++k) {
            const seen_lanes surface = seen(own.bins, glm::dvec2(middle), own.packs[k]);
            for (std::size_t lane = 0; lane < texel_pack::size; ++lane) {
                const glm::ivec2 inside = at.place(lane);
                if (inside.x >= tile.size.x || inside.y >= tile.size.y) continue;
                const sample_place& p = own.places[k * texel_pack::size + lane];
                to.of[tile.pixel(inside) * count + k] = {p.x,
                                                         p.y,
                                                         p.t,
                                                         surface.z[lane],
                                                         surface.d_x[lane],
                                                         surface.d_y[lane],
                                                         surface.d_z[lane],
                                                         surface.id[lane]};
            }
        }
    }
}

} // namespace

sample_picture rasterize_samples(const moving_scene& world, const moving_camera& eye, int width, int height,
                                 const sample_options& how)
{
    const sample_source source(how);
    const bool centred = how.pattern == sample_pattern::centres;
    const tiled_triangles scenery(world, eye, width, height, faces::both, centred ? 0.f : 0.5f);
    sample_picture result{width, height, how.samples, {}};
    result.of.resize(std::size_t(width) * std::size_t(height) * std::size_t(how.samples));
    tbb::enumerable_thread_specific<scratch> own;
    tbb::parallel_for(std::size_t(0), scenery.tiles(),
                      [&](std::size_t tile) { rasterize_tile(scenery, tile, source, own.local(), result); });
    return result;
}

} // namespace gnomon::renderer
