#include "moving_tiles.hpp"

#include <gnomon/passes/range/map.hpp>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace gnomon::renderer {

namespace {

constexpr int largest_map_size = 1 << 14;      // texels
constexpr std::size_t largest_count = 1 << 24; // triangles

bool finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

struct moving_view {
    camera open, close;
    glm::dvec2 size;
    double reach;
    const line_sample<double>* line; // for samples along a line at one instant, or a null pointer

    moving_vertex<double> vertex(const glm::vec3& opening, const glm::vec3& closing) const
    {
        const glm::dvec4 q = texel_space(open, size, opening), r = texel_space(close, size, closing);
        const moving_vertex<double> v{q.x, q.y, q.z, q.w, r.x, r.y, r.z, r.w};
        return line ? line_sample_vertex(v, *line) : v;
    }
};

// Finds the facings that a triangle has at some time: the signs of the determinant of the corners' (x, y, w), a cubic
// in time, bounded by its Bernstein coefficients. The determinant is the edge function across from a corner, at that
// corner. A triangle that has the negative facing alone gets two corners exchanged, and so the positive one.
void set_facing(moving_setup& s, faces visible)
{
    const moving_vertex<double>& a = s.corners.a;
    const edge_equation<double> across = edge_equation_make(s.corners.b, s.corners.c);
    const auto open = [&](const sample_plane<double>& p) { return p.x * a.x0 + p.y * a.y0 + p.c * a.w0; };
    const auto close = [&](const sample_plane<double>& p) { return p.x * a.x1 + p.y * a.y1 + p.c * a.w1; };
    const auto [least, most] = std::minmax({open(across.e0), close(across.e0) + 2 * open(across.e1),
                                            2 * close(across.e1) + open(across.e2), close(across.e2)});
    // Rows are counted downwards, so the corners of a front face run clockwise.
    s.positive = most > 0 && visible != faces::front;
    s.negative = least < 0 && visible != faces::back;
    if (s.positive || !s.negative) return;
    std::swap(s.corners.b, s.corners.c);
    std::swap(s.positive, s.negative);
}

// Finds the texels that a triangle may cover: those between its corners at shutter open and close, which enclose all
// that is between; all texels if a corner is ever behind the eye. Returns false if there are none.
bool set_extent(moving_setup& s, const moving_view& from)
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
    s.before_eye = least_w > 0;
    s.between_planes = -1 < nearest && farthest < 1;
    s.nearest = static_cast<float>(nearest);
    if (!s.before_eye) low = glm::dvec2(0), high = from.size;
    const double reach = from.reach + double(tile_triangle::margin);
    s.first = glm::ivec2(glm::clamp(glm::ceil(low - 0.5 - reach), glm::dvec2(0), from.size));
    s.last = glm::ivec2(glm::clamp(glm::floor(high - 0.5 + reach), glm::dvec2(-1), from.size - 1.0));
    return s.first.x <= s.last.x && s.first.y <= s.last.y;
}

// Finds the edges that are linear in time but for the rounding of positions in float, 2^-24 of the picture's extent
// each. An edge is judged by its own two corners, hence alike for both triangles that share it: a crack of that size
// may open beside a vertex alone.
void set_linear(moving_setup& s, const moving_view& from)
{
    constexpr double rounding = 0x1p-22;
    moving_vertex<double>&a = s.corners.a, &b = s.corners.b, &c = s.corners.c;
    if (!s.before_eye) return;
    const double tolerance = rounding * std::max(from.size.x, from.size.y);
    s.linear_edges = {moving_edge_nonlinearity(b, c) <= tolerance, moving_edge_nonlinearity(c, a) <= tolerance,
                      moving_edge_nonlinearity(a, b) <= tolerance};
    const auto [least, most] = std::minmax({a.z1 - a.z0, b.z1 - b.z0, c.z1 - c.z0});
    s.linear = glm::all(s.linear_edges) && most - least <= rounding;
    if (!s.linear) return;
    for (moving_vertex<double>* v : {&a, &b, &c}) v->z1 = v->z0 + 0.5 * (least + most);
}

std::vector<moving_setup> set_up(const moving_scene& world, const moving_view& from, faces visible)
{
    std::vector<moving_setup> all;
    const std::size_t triangles =
        std::transform_reduce(world.open.meshes.begin(), world.open.meshes.end(), std::size_t(0), std::plus(),
                              [](const mesh& part) { return part.triangles.size(); });
    if (triangles > largest_count)
        throw std::invalid_argument(
            fmt::format("moving rasterizer: {} triangles, {} are possible: a number is an id, which float must hold",
                        triangles, largest_count));
    all.reserve(triangles);
    std::uint32_t number = 0;
    for (std::size_t m = 0; m < world.open.meshes.size(); ++m) {
        const mesh& part = world.open.meshes[m];
        std::vector<moving_vertex<double>> vertices(part.positions.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::vec3 &open = part.positions[i], &close = world.closing[m][i];
            if (!finite(open) || !finite(close))
                throw std::invalid_argument(
                    fmt::format("moving rasterizer: vertex {} of mesh {} is not at a finite place", i, m));
            vertices[i] = from.vertex(open, close);
        }
        for (const glm::uvec3& t : part.triangles) {
            moving_setup s{};
            s.corners = {vertices[t.x], vertices[t.y], vertices[t.z]};
            s.number = number++;
            if (!set_extent(s, from)) continue;
            set_facing(s, visible);
            if (!s.positive && !s.negative) continue;
            set_linear(s, from);
            all.push_back(s);
        }
    }
    return all;
}

// Calls visit(tile) for the tiles in which a triangle is seen at some time.
template <class Visit> void for_each_tile(const moving_setup& s, const Visit& visit)
{
    const glm::ivec2 low = s.first / moving_tile_size, extent = s.last / moving_tile_size - low + 1;
    const int count = extent.x * extent.y;
    if (count <= 2) { // one tile, or two neighbours: the triangle reaches into both
        visit(low);
        if (count == 2) visit(low + extent - 1);
        return;
    }
    const glm::dvec2 origin = double(moving_tile_size) * (glm::dvec2(low) + 0.5 * glm::dvec2(extent));
    const auto equations = rounded_to<float>(triangle_setup_make(s.corners, origin.x, origin.y));
    const edge_errors errors(equations, s.linear_edges, 0.5f * float(moving_tile_size) * glm::vec2(extent));
    const cell_test touched(equations, errors, s, 0.5f * float(moving_tile_size) + tile_triangle::margin);
    const auto tile = [&](int i) { return low + glm::ivec2(i % extent.x, i / extent.x); };
    for (int begin = 0; begin < count; begin += int(texel_pack::size)) {
        texel_lanes x, y;
        for (std::size_t i = 0; i < texel_pack::size; ++i) {
            const glm::dvec2 middle = double(moving_tile_size) * (glm::dvec2(tile(begin + int(i))) + 0.5) - origin;
            x[i] = float(middle.x), y[i] = float(middle.y);
        }
        for_each_bit(touched(texel_pack::load_unaligned(x.data()), texel_pack::load_unaligned(y.data())),
                     [&](std::size_t lane) {
                         if (begin + int(lane) < count) visit(tile(begin + int(lane)));
                     });
    }
}

} // namespace

tiled_triangles::tiled_triangles(const moving_scene& world, const moving_camera& eye, int width, int height,
                                 faces visible, float reach, const line_sample<double>* line)
    : size_(width, height), grid_((size_ + moving_tile_size - 1) / moving_tile_size), reach_(reach)
{
    if (width < 1 || height < 1 || width > largest_map_size || height > largest_map_size)
        throw std::invalid_argument(fmt::format("moving rasterizer: {}x{} texels, 1 to {} per side are possible", width,
                                                height, largest_map_size));
    setups_ = set_up(world, {eye.open, eye.at(1), size_, double(reach), line}, visible);
    sort_into_tiles();
}

moving_tile tiled_triangles::tile(std::size_t i) const
{
    const glm::ivec2 corner = moving_tile_size * glm::ivec2(int(i) % grid_.x, int(i) / grid_.x);
    return {corner, glm::min(glm::ivec2(moving_tile_size), size_ - corner), size_.x};
}

void tiled_triangles::sort_into_tiles()
{
    struct member {
        std::uint32_t tile, triangle;
    };
    tbb::enumerable_thread_specific<std::vector<member>> local;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, setups_.size(), 64), [&](const auto& some) {
        std::vector<member>& found = local.local();
        for (std::size_t i = some.begin(); i < some.end(); ++i)
            for_each_tile(setups_[i], [&](const glm::ivec2& tile) {
                found.push_back({static_cast<std::uint32_t>(tile.y * grid_.x + tile.x), static_cast<std::uint32_t>(i)});
            });
    });
    first_.assign(static_cast<std::size_t>(grid_.x * grid_.y) + 1, 0);
    for (const auto& found : local)
        for (const member& m : found) ++first_[m.tile];
    begins_from_counts(first_);
    members_.resize(first_.back());
    std::vector<std::uint32_t> next = first_;
    for (const auto& found : local)
        for (const member& m : found) members_[next[m.tile]++] = m.triangle;
    // Sort, so that the order does not depend on which thread found what.
    tbb::parallel_for(std::size_t(0), tiles(), [&](std::size_t i) {
        std::sort(members_.begin() + first_[i], members_.begin() + first_[i + 1]);
    });
}

tile_triangle::tile_triangle(const moving_setup& s, const moving_tile& where)
    : tile_triangle(s, where,
                    triangle_setup_make(s.corners, double(where.corner.x) + 0.5 * moving_tile_size,
                                        double(where.corner.y) + 0.5 * moving_tile_size))
{}

tile_triangle::tile_triangle(const moving_setup& s, const moving_tile& where, const triangle_setup<double>& equations)
    : setup_(&s),
      last_(glm::min(s.last - where.corner, where.size - 1)),
      low_(glm::max(s.first - where.corner, 0) / moving_block_size),
      high_(last_ / moving_block_size),
      whole_(where.size == glm::ivec2(moving_tile_size)),
      depths_(rounded_to<float>(depth_setup_make(equations, s.corners)))
{
    wide_ = rounded_to<float>(equations);
    errors_ = {wide_, s.linear_edges, glm::vec2(0.5f * float(moving_tile_size))};
    wide_ = widen(wide_, errors_, 1);
}

} // namespace gnomon::renderer
