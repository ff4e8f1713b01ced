#include "moving_samples.hpp"

#include "moving_tiles.hpp"

#include <gnomon/motion/triangle/triangle_motion.h>

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
    explicit sample_source(const sample_options& how) : how_(how), count_(float(how.samples))
    {
        if (how.samples < 1 || how.samples > int(texel_limit))
            throw std::invalid_argument(
                fmt::format("moving samples: {} samples, 1 to {} are possible", how.samples, int(texel_limit)));
        if (how.pattern == sample_pattern::stratified) draw_strata();
    }

    // Calls put(k, place) for the samples of a texel.
    template <class Put> void operator()(const glm::ivec2& texel, const Put& put) const
    {
        const std::uint64_t own =
            mixed(std::uint64_t(how_.seed) << 32 | std::uint64_t(texel.y) << 16 | std::uint64_t(texel.x));
        const std::size_t samples = std::size_t(how_.samples), strata = (own >> 56) * samples;
        for (std::size_t k = 0; k < samples; ++k) {
            const std::uint64_t bits = mixed(own + k);
            sample_place at{0.5f, 0.5f, stratified_time(float(k), count_, jitter(bits, 0))};
            if (how_.pattern != sample_pattern::centres) at.x = jitter(bits, 20), at.y = jitter(bits, 40);
            if (how_.pattern == sample_pattern::stratified) {
                at.x = (float(strata_[strata + k].x) + at.x) / count_;
                at.y = (float(strata_[strata + k].y) + at.y) / count_;
            }
            put(k, at);
        }
    }

  private:
    static constexpr int patterns = 256;

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
    const float count_;
    std::vector<glm::ivec2> strata_; // sample k of pattern p is number p samples + k
};

// One sample of each texel of a pack, with the nearest triangle so far.
struct sample_pack {
    texel_pack x, y, t; // from the middle of the tile
    texel_pack z, triangle;
};

constexpr float none = -1;

// Puts a triangle into the samples that see it, in front of what they have seen so far.
template <class Coverage>
GNOMON_INLINE void put_facing(const Coverage& coverage, float facing, float number, sample_pack& s)
{
    const auto inside = [&](const moving_edge<texel_pack>& e) { return texel_pack(facing) * moving_edge_at(e, s.t); };
    const texel_pack least =
        gnomon_min(gnomon_min(inside(coverage.edges.a), inside(coverage.edges.b)), inside(coverage.edges.c));
    const auto covered = texel_pack(0.f) <= least;
    if (!gnomon_any(covered)) return;
    const texel_pack z = coverage.depth(s.t);
    const auto nearer = covered && texel_pack(-1.f) < z && z < s.z;
    s.z = gnomon_select(nearer, z, s.z);
    s.triangle = gnomon_select(nearer, texel_pack(number), s.triangle);
}

void put(const tile_triangle& triangle, float number, moving_samples at, std::span<sample_pack> samples)
{
    const moving_setup& setup = triangle.setup();
    for (sample_pack& s : samples) {
        at.x = s.x, at.y = s.y;
        for (const float facing : {1.f, -1.f}) {
            if (!(facing > 0 ? setup.positive : setup.negative)) continue;
            if (setup.linear) put_facing(triangle.linear(at, facing), facing, number, s);
            else put_facing(triangle.quadratic(at, facing), facing, number, s);
        }
    }
}

// The sample of a triangle, in double precision.
stochastic_sample<float> seen(const moving_setup& triangle, float x, float y, float t)
{
    const moving_triangle<double>& m = triangle.corners;
    const moving_edges<double> edges = moving_triangle_edges(m, double(x), double(y));
    const triangle_motion<double> d = moving_triangle_motion(m, edges, double(t), 0.0);
    const auto z = float(moving_depth_at(m, edges, double(t), 0.0));
    return {x, y, t, z, float(d.d_x), float(d.d_y), float(d.d_z), float(triangle.number)};
}

struct scratch {
    tile_bins bins;
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
        const moving_samples at(i);
        if (glm::any(glm::greaterThanEqual(moving_block_size * at.block, tile.size))) continue;
        for (std::size_t lane = 0; lane < texel_pack::size; ++lane) {
            const glm::ivec2 texel = tile.corner + at.place(lane);
            source(texel, [&](std::size_t k, sample_place place) {
                // Rounding may not move a place into the next texel.
                const glm::vec2 low(texel), inside(std::nextafter(low.x + 1, 0.f), std::nextafter(low.y + 1, 0.f));
                place.x = std::min(low.x + place.x, inside.x), place.y = std::min(low.y + place.y, inside.y);
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
        own.bins.for_each(i / moving_samples::packs_per_block, [&](const tile_triangle& triangle) {
            put(triangle, float(own.bins.index_of(triangle)), at, own.packs);
        });
        for (std::size_t k = 0; k < count; ++k) {
            texel_lanes triangle;
            own.packs[k].triangle.store_unaligned(triangle.data());
            for (std::size_t lane = 0; lane < texel_pack::size; ++lane) {
                const glm::ivec2 inside = at.place(lane);
                if (inside.x >= tile.size.x || inside.y >= tile.size.y) continue;
                const sample_place& p = own.places[k * texel_pack::size + lane];
                to.of[tile.pixel(inside) * count + k] =
                    triangle[lane] < 0 ? stochastic_background(p.x, p.y, p.t)
                                       : seen(own.bins[std::size_t(triangle[lane])].setup(), p.x, p.y, p.t);
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
