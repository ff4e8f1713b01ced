// A scene is a list of triangle meshes, each of one albedo and opaque or translucent. y points up; units are arbitrary.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace gnomon::renderer {

struct mesh {
    std::string name;
    glm::vec3 albedo{0.7f};
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;    // one per position, or none: then the triangles' own normals are shaded
    std::vector<glm::uvec3> triangles; // counter-clockwise when seen from outside

    // The share of red, green and blue light that a surface stops. Each triangle is a surface: a box stops light twice.
    glm::vec3 opacity{1};
    std::vector<glm::vec2> texture_coordinates{}; // one per position, or none
    float (*alpha)(const glm::vec2&) = nullptr;   // factor of the opacity in [0, 1], over the texture coordinates

    // True if all light is stopped everywhere.
    bool opaque() const;

    // The opacity in [0, 1] at a point of a triangle, by weights of its corners.
    glm::vec3 opacity_at(std::uint32_t triangle, const glm::vec3& weights) const;
};

struct scene {
    std::string name;
    std::vector<mesh> meshes;
};

// An axis-aligned box; the default one is empty.
struct bounds {
    glm::vec3 lower{std::numeric_limits<float>::infinity()};
    glm::vec3 upper{-std::numeric_limits<float>::infinity()};

    void include(const glm::vec3& point);
    bool empty() const;
    glm::vec3 centre() const;
    glm::vec3 extent() const;
    std::array<glm::vec3, 8> corners() const;
};

bounds bounds_of(const scene& world);

// The meshes that are opaque, and those that are not. The other ones lose their triangles, so that indices stay.
scene opaque_part(const scene& world);
scene translucent_part(const scene& world);

// The place of a solid: its centre, and its three axes as columns, each as long as half of the solid.
struct placement {
    glm::vec3 centre{0};
    glm::mat3 half_axes{1};
};

// Half axes of an upright solid of this full size, turned about y by an angle in radians.
placement upright(const glm::vec3& centre, const glm::vec3& size, float angle = 0);

// A mesh without triangles, for builders.
mesh painted(std::string name, const glm::vec3& albedo);

// Builders append to a mesh, so that many parts can share one albedo.
void add_quad(mesh& target, const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v);
void add_box(mesh& target, const placement& where);

// A quad whose texture coordinates go from `first` at the corner to `last` at the opposite one.
void add_textured_quad(mesh& target, const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v,
                       const glm::vec2& first, const glm::vec2& last);

// Extrudes a convex, counter-clockwise outline in [-1, 1]^2, which spans the first two half axes, along the third.
void add_prism(mesh& target, std::span<const glm::vec2> outline, const placement& where);

mesh ground(const glm::vec3& centre, float width, float depth, const glm::vec3& albedo);

} // namespace gnomon::renderer
