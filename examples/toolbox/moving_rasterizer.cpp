#include "moving_rasterizer.hpp"

#include <fmt/format.h>
#include <gnomon/motion/edge_field.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <gnomon/passes/resolve.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <stdexcept>

namespace gnomon::toolbox {

namespace {

using pack = xsimd::batch<float>;
using lanes = std::array<float, pack::size>;

constexpr int tile_size = 32, block_size = 4, blocks_per_side = tile_size / block_size;
constexpr int largest_extent = 1 << 14; // texels
// What blocks are tested for beyond their samples, in texels: more than rounding takes from them.
constexpr float margin = 0.05f;

// The samples of a tile's first block, from the middle of the tile; a pack may be longer than they are.
template <bool Row> constexpr auto block_coordinates()
{
    std::array<float, std::max<std::size_t>(block_size * block_size, pack::size)> result{};
    for (int i = 0; i < int(result.size()); ++i)
        result[std::size_t(i)] = float(Row ? i / block_size : i % block_size) + 0.5f - 0.5f * float(tile_size);
    return result;
}
constexpr auto block_x = block_coordinates<false>(), block_y = block_coordinates<true>();

// A triangle ready to be sampled: x and y in texels times w, z the linear depth.
struct setup {
    moving_triangle<double> corners;
    glm::ivec2 first, last; // texels that it may cover, both included
    bool front, back;       // whether it shows this side at some time
    std::uint32_t number;
};

moving_vertex<double> vertex_between(const glm::dvec4& q, const glm::dvec4& r)
{
    return {q.x, q.y, q.z, q.w, r.x, r.y, r.z, r.w};
}

struct view {
    camera open, close;
    glm::dvec2 size;

    view(const moving_camera& eye, int width, int height) : open(eye.open), close(eye.at(1)), size(width, height) {}

    glm::dvec4 clip_space(const camera& eye, const glm::dvec3& point) const
    {
        const glm::dvec3 offset = point - eye.position;
        const double distance = glm::dot(offset, eye.forward), w = eye.perspective() ? distance : 1;
        const glm::dvec2 ndc = glm::dvec2(glm::dot(offset, eye.right), -glm::dot(offset, eye.up)) / eye.half_extent;
        return {0.5 * size * (ndc + w), linear_depth(eye, distance), w};
    }

    moving_vertex<double> vertex(const glm::vec3& opening, const glm::vec3& closing) const
    {
        return vertex_between(clip_space(open, opening), clip_space(close, closing));
    }
};

// Which sides of it are seen: the sign of the determinant of the corners' (x, y, w), a cubic in time, by its Bernstein
// coefficients.
void set_facing(setup& s, faces visible)
{
    const auto column = [](const moving_vertex<double>& v, bool late) {
        return late ? glm::dvec3(v.x1, v.y1, v.w1) : glm::dvec3(v.x0, v.y0, v.w0);
    };
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int late = 0; late <= 3; ++late) {
        double sum = 0;
        for (unsigned which = 0; which < 8; ++which)
            if (std::popcount(which) == late)
                sum += glm::determinant(glm::dmat3(column(s.corners.a, which & 1), column(s.corners.b, which & 2),
                                                   column(s.corners.c, which & 4)));
        least = std::min(least, sum), most = std::max(most, sum);
    }
    // Texels count rows downwards: what turns its front to the eye runs clockwise.
    s.front = least < 0 && visible != faces::back;
    s.back = most > 0 && visible != faces::front;
}

// Where its corners are seen at both ends, and hence in between; everywhere if one is ever behind the eye.
bool set_extent(setup& s, const view& from)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(infinity), high(-infinity);
    double nearest = infinity, farthest = -infinity, least_w = infinity;
    for (const moving_vertex<double>* v : {&s.corners.a, &s.corners.b, &s.corners.c}) {
        for (const glm::dvec2& at : {glm::dvec2(v->x0, v->y0) / v->w0, glm::dvec2(v->x1, v->y1) / v->w1})
            low = glm::min(low, at), high = glm::max(high, at);
        nearest = std::min({nearest, v->z0, v->z1}), farthest = std::max({farthest, v->z0, v->z1});
        least_w = std::min({least_w, v->w0, v->w1});
    }
    if (!(nearest <= 1) || !(farthest >= -1)) return false;
    if (!(least_w > 0)) low = glm::dvec2(0), high = from.size;
    s.first = glm::ivec2(glm::clamp(glm::ceil(low - 0.5 - double(margin)), glm::dvec2(0), from.size));
    s.last = glm::ivec2(glm::clamp(glm::floor(high - 0.5 + double(margin)), glm::dvec2(-1), from.size - 1.0));
    return s.first.x <= s.last.x && s.first.y <= s.last.y;
}

std::vector<setup> set_up(const moving_scene& world, const view& from, faces visible)
{
    std::vector<setup> all;
    std::uint32_t number = 0;
    for (std::size_t m = 0; m < world.open.meshes.size(); ++m) {
        const mesh& part = world.open.meshes[m];
        std::vector<moving_vertex<double>> vertices(part.positions.size());
        for (std::size_t i = 0; i < vertices.size(); ++i)
            vertices[i] = from.vertex(part.positions[i], world.closing[m][i]);
        for (const glm::uvec3& t : part.triangles) {
            setup s{};
            s.corners = {vertices[t.x], vertices[t.y], vertices[t.z]};
            s.number = number++;
            if (!set_extent(s, from)) continue;
            set_facing(s, visible);
            if (s.front || s.back) all.push_back(s);
        }
    }
    return all;
}

moving_field<float> field_from(const moving_triangle<double>& corners, const glm::dvec2& origin)
{
    const auto exact = std::bit_cast<std::array<double, 27>>(moving_field_of(corners, origin.x, origin.y));
    std::array<float, 27> rounded;
    std::ranges::transform(exact, rounded.begin(), [](double x) { return static_cast<float>(x); });
    return std::bit_cast<moving_field<float>>(rounded);
}

moving_field<pack> broadcast(const moving_field<float>& field)
{
    const auto scalars = std::bit_cast<std::array<float, 27>>(field);
    std::array<pack, 27> packs;
    std::ranges::transform(scalars, packs.begin(), [](float x) { return pack(x); });
    return std::bit_cast<moving_field<pack>>(packs);
}

// Calls visit(column, row) for each cell of a grid whose samples, within reach of its middle, the triangle covers at
// some time; the cell (0, 0) has its middle at `start` from the field's origin.
template <class Visit>
void for_each_touched(const moving_field<pack>& field, const setup& s, glm::ivec2 low, glm::ivec2 high,
                      const glm::vec2& start, float step, float reach, const Visit& visit)
{
    const int columns = high.x - low.x + 1, cells = columns * (high.y - low.y + 1);
    lanes x, y, duration;
    int column = low.x, row = low.y;
    for (int begin = 0; begin < cells; begin += int(pack::size)) {
        const int count = std::min(cells - begin, int(pack::size)), first_column = column, first_row = row;
        for (std::size_t i = 0; i < pack::size; ++i) {
            x[i] = start.x + step * float(column), y[i] = start.y + step * float(row);
            if (++column > high.x) column = low.x, ++row;
        }
        const pack s_x = pack::load_unaligned(x.data()), s_y = pack::load_unaligned(y.data());
        pack covered(0.f);
        for (const float facing : {1.f, -1.f})
            if (facing > 0 ? s.back : s.front) // y points down
                covered += coverage_duration(moving_coverage(
                    moving_field_block(field, s_x, s_y, pack(reach), pack(reach), pack(facing)), pack(facing)));
        covered.store_unaligned(duration.data());
        column = first_column, row = first_row;
        for (std::size_t i = 0; i < pack::size; ++i) {
            if (int(i) < count && duration[i] > 0) visit(column, row);
            if (++column > high.x) column = low.x, ++row;
        }
    }
}

// Tile of a grid, and a triangle in it.
struct tile_member {
    std::uint32_t tile, triangle;
};

struct tile_grid {
    int columns, rows;
    std::vector<std::uint32_t> first; // of each tile
    std::vector<std::uint32_t> members;
};

tile_grid sort_into_tiles(const std::vector<setup>& setups, int width, int height)
{
    tile_grid grid{(width + tile_size - 1) / tile_size, (height + tile_size - 1) / tile_size, {}, {}};
    tbb::enumerable_thread_specific<std::vector<tile_member>> local;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, setups.size(), 64), [&](const auto& some) {
        std::vector<tile_member>& found = local.local();
        for (std::size_t i = some.begin(); i < some.end(); ++i) {
            const setup& s = setups[i];
            const glm::ivec2 low = s.first / tile_size, high = s.last / tile_size;
            const auto add = [&](int column, int row) {
                found.push_back({std::uint32_t(row * grid.columns + column), std::uint32_t(i)});
            };
            if (low == high) {
                add(low.x, low.y);
                continue;
            }
            const glm::dvec2 origin = double(tile_size) * 0.5 * glm::dvec2(low + high + 1);
            const glm::vec2 start = double(tile_size) * (glm::dvec2(low) + 0.5) - origin;
            const glm::vec2 zero = start - float(tile_size) * glm::vec2(low);
            for_each_touched(broadcast(field_from(s.corners, origin)), s, low, high, zero, float(tile_size),
                             0.5f * float(tile_size) + margin, add);
        }
    });
    grid.first.assign(std::size_t(grid.columns * grid.rows) + 1, 0);
    for (const auto& found : local)
        for (const tile_member& m : found) ++grid.first[m.tile];
    begins_from_counts(grid.first);
    grid.members.resize(grid.first.back());
    std::vector<std::uint32_t> next = grid.first;
    for (const auto& found : local)
        for (const tile_member& m : found) grid.members[next[m.tile]++] = m.triangle;
    return grid;
}

// Ranges as they come, each with its texel in the picture.
struct loose_ranges {
    std::vector<std::uint32_t> texels;
    std::vector<depth_time_range<float>> ranges;

    std::size_t size() const { return texels.size(); }
    void add(std::uint32_t texel, const depth_time_range<float>& r)
    {
        texels.push_back(texel);
        ranges.push_back(r);
    }
    void cut_to(std::size_t size) { texels.resize(size), ranges.resize(size); }
};

// A tile's part of the loose ranges of a thread.
struct tile_part {
    const loose_ranges* of = nullptr;
    std::size_t begin = 0, end = 0;
};

// What one thread needs, tile after tile.
struct thread_state {
    loose_ranges loose;
    range_counts counts;
    std::vector<std::uint32_t> members, inside, first;
    std::vector<depth_time_range<float>> lists;
    std::vector<visible_span<float>> spans;
};

struct tile {
    glm::ivec2 corner, size; // size: of what lies in the picture
    int picture_width;

    std::uint32_t texel(glm::ivec2 inside) const
    {
        return std::uint32_t((corner.y + inside.y) * picture_width + corner.x + inside.x);
    }
};

// The loose ranges from begin on, all of one tile, become what of them is in front.
void resolve(thread_state& t, const tile& where, std::size_t begin)
{
    constexpr std::uint32_t texels = tile_size * tile_size;
    const auto inside = [&](std::uint32_t texel) {
        const auto width = std::uint32_t(where.picture_width);
        return (texel / width - std::uint32_t(where.corner.y)) * tile_size + texel % width -
               std::uint32_t(where.corner.x);
    };
    t.inside.assign(t.loose.texels.begin() + std::ptrdiff_t(begin), t.loose.texels.end());
    std::ranges::transform(t.inside, t.inside.begin(), inside);
    t.first.resize(texels + 1);
    t.lists.resize(t.inside.size());
    sort_into_lists<float>(t.inside, std::span(t.loose.ranges).subspan(begin), t.first, t.lists);
    t.loose.cut_to(begin);
    for (std::uint32_t i = 0; i < texels; ++i) {
        const auto list =
            std::span<const depth_time_range<float>>(t.lists).subspan(t.first[i], t.first[i + 1] - t.first[i]);
        if (list.empty()) continue;
        t.spans.resize(std::max(t.spans.size(), resolve_capacity(list.size())));
        const std::uint32_t texel = where.texel({int(i) % tile_size, int(i) / tile_size});
        for (const visible_span<float>& s : resolve_ranges<float>(list, t.spans)) t.loose.add(texel, range_of(list, s));
    }
}

moving_triangle<pack> broadcast_depths(const moving_triangle<double>& m)
{
    const auto vertex = [](const moving_vertex<double>& v) {
        moving_vertex<pack> r{};
        r.z0 = pack(float(v.z0)), r.z1 = pack(float(v.z1)), r.w0 = r.w1 = pack(1.f);
        return r;
    };
    return {vertex(m.a), vertex(m.b), vertex(m.c)};
}

// The texels of one triangle in one tile.
void sample_tile(const setup& s, const tile& where, thread_state& out)
{
    const glm::ivec2 last = glm::min(s.last - where.corner, where.size - 1);
    const glm::ivec2 low = glm::max(s.first - where.corner, 0) / block_size, high = last / block_size;
    const moving_field<pack> field = broadcast(field_from(s.corners, glm::dvec2(where.corner) + 0.5 * tile_size));
    const moving_triangle<pack> depths = broadcast_depths(s.corners);
    const auto sample_block = [&](int column, int row) {
        constexpr int samples = block_size * block_size;
        const glm::ivec2 corner = block_size * glm::ivec2(column, row);
        for (int begin = 0; begin < samples; begin += int(pack::size)) {
            const pack s_x = pack::load_unaligned(&block_x[std::size_t(begin)]) + pack(float(corner.x));
            const pack s_y = pack::load_unaligned(&block_y[std::size_t(begin)]) + pack(float(corner.y));
            const moving_edges<pack> edges = moving_field_edges(field, s_x, s_y);
            out.counts.tested += pack::size;
            for (const float facing : {1.f, -1.f}) {
                if (!(facing > 0 ? s.back : s.front)) continue; // y points down
                const coverage_times<pack> times = moving_coverage(edges, pack(facing));
                if (!gnomon_any(times.count > pack(0.f))) continue;
                lanes count, t0, t1, z0, z1;
                times.count.store_unaligned(count.data());
                const std::array<std::array<pack, 2>, 4> intervals{{{times.begin0, times.end0},
                                                                    {times.begin1, times.end1},
                                                                    {times.begin2, times.end2},
                                                                    {times.begin3, times.end3}}};
                for (int k = 0; k < 4 && gnomon_any(times.count > pack(float(k))); ++k) {
                    const auto& [opening, closing] = intervals[std::size_t(k)];
                    opening.store_unaligned(t0.data());
                    closing.store_unaligned(t1.data());
                    moving_triangle_depth(depths, edges, opening).store_unaligned(z0.data());
                    moving_triangle_depth(depths, edges, closing).store_unaligned(z1.data());
                    for (std::size_t i = 0; i < pack::size; ++i) {
                        if (!(count[i] > float(k))) continue;
                        const int sample = begin + int(i);
                        const glm::ivec2 texel = corner + glm::ivec2(sample % block_size, sample / block_size);
                        if (texel.x > last.x || texel.y > last.y) continue; // beyond the picture
                        out.counts.pairs += k == 0;
                        out.loose.add(where.texel(texel), {t0[i], t1[i], z0[i], z1[i], float(s.number)});
                    }
                }
            }
        }
    };
    if (low == high) return sample_block(low.x, low.y);
    const glm::vec2 start(0.5f * float(block_size - tile_size));
    for_each_touched(field, s, low, high, start, float(block_size), 0.5f * float(block_size - 1) + margin,
                     sample_block);
}

} // namespace

struct range_rasterizer::scratch {
    tbb::enumerable_thread_specific<thread_state> threads;
    std::vector<tile_part> parts;
};

range_rasterizer::range_rasterizer() : scratch_(std::make_unique<scratch>()) {}
range_rasterizer::~range_rasterizer() = default;

const range_lists& range_rasterizer::operator()(const moving_scene& world, const moving_camera& eye, int width,
                                                int height, const range_options& how)
{
    if (width < 1 || height < 1 || width > largest_extent || height > largest_extent)
        throw std::invalid_argument(fmt::format("moving rasterizer: {}x{} texels, 1 to {} per side are possible", width,
                                                height, largest_extent));
    const std::vector<setup> setups = set_up(world, {eye, width, height}, how.visible);
    const tile_grid grid = sort_into_tiles(setups, width, height);
    const std::size_t tiles = grid.first.size() - 1;

    lists_.width = width, lists_.height = height, lists_.counts = {};
    lists_.first.assign(std::size_t(width) * std::size_t(height) + 1, 0);
    for (thread_state& t : scratch_->threads) t.loose.cut_to(0), t.counts = {};
    scratch_->parts.resize(tiles);
    tbb::parallel_for(std::size_t(0), tiles, [&](std::size_t i) {
        thread_state& t = scratch_->threads.local();
        const glm::ivec2 corner = tile_size * glm::ivec2(int(i) % grid.columns, int(i) / grid.columns);
        const tile where{corner, glm::min(glm::ivec2(tile_size), glm::ivec2(width, height) - corner), width};
        const auto begin = grid.members.begin();
        t.members.assign(begin + grid.first[i], begin + grid.first[i + 1]);
        std::ranges::sort(t.members); // in whichever order threads have found them
        const std::size_t before = t.loose.size();
        std::size_t budget = how.tile_budget;
        for (const std::uint32_t member : t.members) {
            sample_tile(setups[member], where, t);
            if (t.loose.size() - before <= budget) continue;
            ++t.counts.early_resolves;
            resolve(t, where, before);
            budget = std::max(budget, 2 * (t.loose.size() - before));
        }
        if (how.resolved) resolve(t, where, before);
        scratch_->parts[i] = {&t.loose, before, t.loose.size()};
        for (std::size_t k = before; k < t.loose.size(); ++k) ++lists_.first[t.loose.texels[k]];
    });
    begins_from_counts(lists_.first);
    lists_.ranges.resize(lists_.first.back());
    tbb::parallel_for(std::size_t(0), tiles, [&](std::size_t i) {
        const tile_part& part = scratch_->parts[i];
        for (std::size_t k = part.begin; k < part.end; ++k)
            lists_.ranges[lists_.first[part.of->texels[k]]++] = part.of->ranges[k];
    });
    std::shift_right(lists_.first.begin(), lists_.first.end(), 1); // each list's end is where the next begins
    lists_.first[0] = 0;
    for (const thread_state& t : scratch_->threads) {
        lists_.counts.pairs += t.counts.pairs;
        lists_.counts.tested += t.counts.tested;
        lists_.counts.early_resolves += t.counts.early_resolves;
    }
    return lists_;
}

std::size_t range_lists::bytes() const
{
    return first.size() * sizeof first[0] + ranges.size() * sizeof(depth_time_range<float>);
}

triangle_numbers::triangle_numbers(const scene& world) : begins_{0}
{
    for (const mesh& part : world.meshes)
        begins_.push_back(begins_.back() + static_cast<std::uint32_t>(part.triangles.size()));
}

triangle_place triangle_numbers::operator[](std::uint32_t number) const
{
    const auto next = std::upper_bound(begins_.begin(), begins_.end() - 1, number);
    const auto mesh = static_cast<std::uint32_t>(next - begins_.begin() - 1);
    return {mesh, number - begins_[mesh]};
}

} // namespace gnomon::toolbox
