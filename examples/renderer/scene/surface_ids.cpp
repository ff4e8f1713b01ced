#include "surface_ids.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace gnomon::renderer {

namespace {

constexpr std::size_t most_of_a_part = 20'000;
constexpr double flatness = 0x1p-20; // of the mesh's extent: several roundings of coordinates in float

constexpr std::uint32_t nobody = ~0u;

// The triangles of one mesh at three times. Vertices that coincide at all of these times get one number.
class moving_surface {
  public:
    moving_surface(const mesh& open, std::span<const glm::vec3> closing) : triangles_(open.triangles)
    {
        std::vector<std::uint32_t> order(open.positions.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        const auto place = [&](std::uint32_t i) {
            const glm::vec3 &p = open.positions[i], &q = closing[i];
            return std::tuple(p.x, p.y, p.z, q.x, q.y, q.z);
        };
        std::ranges::sort(order, {}, place);
        std::vector<std::uint32_t> corner(order.size());
        bounds box;
        for (const std::uint32_t i : order) {
            const glm::dvec3 p(open.positions[i]), q(closing[i]);
            box.include(open.positions[i]), box.include(closing[i]);
            if (places_.empty() || places_.back()[0] != p || places_.back()[2] != q)
                places_.push_back({p, 0.5 * (p + q), q});
            corner[i] = static_cast<std::uint32_t>(places_.size() - 1);
        }
        if (!box.empty()) tolerance_ = flatness * double(glm::length(box.extent()));
        for (glm::uvec3& t : triangles_) t = {corner[t.x], corner[t.y], corner[t.z]};
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = triangles_[t][i], b = triangles_[t][(i + 1) % 3];
                edges_[std::minmax(a, b)].push_back({t, a < b});
            }
    }

    // The first triangle of the surface of each triangle.
    std::vector<std::uint32_t> surfaces() const
    {
        const std::vector<std::uint32_t> parts = grown([](std::uint32_t, std::uint32_t) { return true; });
        std::map<std::uint32_t, std::vector<std::uint32_t>> members;
        for (std::uint32_t t = 0; t < parts.size(); ++t) members[parts[t]].push_back(t);
        std::vector<std::uint32_t> result =
            grown([&](std::uint32_t seed, std::uint32_t t) { return in_plane(seed, triangles_[t]); });
        for (const auto& [first, part] : members)
            if (is_closed(part) && is_convex(part))
                for (const std::uint32_t t : part) result[t] = first;
        return result;
    }

  private:
    struct side {
        std::uint32_t triangle;
        bool forwards; // along the edge, from its lower corner
    };

    // Visits, from each triangle not yet visited, the neighbours over edges for which join(seed, triangle) is true.
    template <class Join> std::vector<std::uint32_t> grown(const Join& join) const
    {
        std::vector<std::uint32_t> result(triangles_.size(), nobody), waiting;
        for (std::uint32_t seed = 0; seed < triangles_.size(); ++seed) {
            if (result[seed] != nobody) continue;
            result[seed] = seed;
            waiting.push_back(seed);
            while (!waiting.empty()) {
                const glm::uvec3 t = triangles_[waiting.back()];
                waiting.pop_back();
                for (int i = 0; i < 3; ++i)
                    for (const side& s : edges_.at(std::minmax(t[i], t[(i + 1) % 3])))
                        if (result[s.triangle] == nobody && join(seed, s.triangle)) {
                            result[s.triangle] = seed;
                            waiting.push_back(s.triangle);
                        }
            }
        }
        return result;
    }

    // The distance of a vertex in front of a triangle, times the length of the triangle's normal, and that length, at
    // one of the times.
    std::pair<double, double> distance(const glm::uvec3& of, std::uint32_t corner, std::size_t time) const
    {
        const glm::dvec3 a = places_[of.x][time];
        const glm::dvec3 normal = glm::cross(places_[of.y][time] - a, places_[of.z][time] - a);
        return {glm::dot(normal, places_[corner][time] - a), glm::length(normal)};
    }

    // A triangle without an area has no plane.
    bool in_plane(std::uint32_t seed, const glm::uvec3& corners) const
    {
        for (std::size_t time = 0; time < 3; ++time)
            for (int i = 0; i < 3; ++i) {
                const auto [ahead, length] = distance(triangles_[seed], corners[i], time);
                if (!(length > 0 && std::abs(ahead) <= tolerance_ * length)) return false;
            }
        return true;
    }

    // True if every edge has two triangles, one on either side.
    bool is_closed(std::span<const std::uint32_t> part) const
    {
        for (const std::uint32_t t : part)
            for (int i = 0; i < 3; ++i) {
                const auto& sides = edges_.at(std::minmax(triangles_[t][i], triangles_[t][(i + 1) % 3]));
                if (sides.size() != 2 || sides[0].forwards == sides[1].forwards) return false;
            }
        return true;
    }

    // True if all vertices are behind all triangles.
    bool is_convex(std::span<const std::uint32_t> part) const
    {
        if (part.size() > most_of_a_part) return false;
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t t : part)
            for (int i = 0; i < 3; ++i) corners.push_back(triangles_[t][i]);
        std::ranges::sort(corners);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        for (std::size_t time = 0; time < 3; ++time)
            for (const std::uint32_t t : part)
                for (const std::uint32_t corner : corners) {
                    const auto [ahead, length] = distance(triangles_[t], corner, time);
                    if (!(ahead <= tolerance_ * length)) return false;
                }
        return true;
    }

    std::vector<std::array<glm::dvec3, 3>> places_; // of each vertex, at shutter open, halfway and at close
    std::vector<glm::uvec3> triangles_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<side>> edges_;
    double tolerance_ = 0;
};

} // namespace

std::vector<std::uint32_t> surface_ids(const moving_scene& world)
{
    std::vector<std::uint32_t> result;
    for (std::size_t m = 0; m < world.open.meshes.size(); ++m) {
        const auto first = static_cast<std::uint32_t>(result.size());
        for (const std::uint32_t t : moving_surface(world.open.meshes[m], world.closing[m]).surfaces())
            result.push_back(first + t);
    }
    return result;
}

} // namespace gnomon::renderer
