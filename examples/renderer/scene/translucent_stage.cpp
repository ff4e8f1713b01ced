#include "translucent_stage.hpp"

#include "paint.hpp"
#include "tube.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::renderer {

namespace {

// The light comes from the front, over the smoke onto the pipes and the walls.
const glm::vec3 yard_light = glm::normalize(glm::vec3(-0.30f, -0.80f, -0.55f));

// A random value in [0, 1] for each point of the lattice of integers.
float lattice_value(const glm::ivec3& at)
{
    std::uint32_t bits = static_cast<std::uint32_t>(at.x) * 0x8da6b343u +
                         static_cast<std::uint32_t>(at.y) * 0xd8163841u +
                         static_cast<std::uint32_t>(at.z) * 0xcb1ab31fu;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    bits = (bits ^ bits >> 12) * 0x297a2d39u;
    return static_cast<float>((bits ^ bits >> 15) >> 8) * 0x1p-24f;
}

// Value noise in [0, 1], with continuous derivatives.
float noise(const glm::vec3& at)
{
    const glm::vec3 cell = glm::floor(at), f = at - cell, t = f * f * (3.f - 2.f * f);
    const glm::ivec3 low(cell);
    const auto row = [&](int y, int z) {
        return glm::mix(lattice_value(low + glm::ivec3(0, y, z)), lattice_value(low + glm::ivec3(1, y, z)), t.x);
    };
    return glm::mix(glm::mix(row(0, 0), row(1, 0), t.y), glm::mix(row(0, 1), row(1, 1), t.y), t.z);
}

// The density of a cloud in the unit cube: fractal noise that thins out towards the sides.
float density(const glm::vec3& at)
{
    const glm::vec3 from_centre = 2.f * at - 1.f;
    const float outwards = glm::dot(from_centre, from_centre);
    if (!(outwards < 1)) return 0;
    float sum = 0, weight = 0.5f;
    glm::vec3 place = 4.f * at;
    for (int octave = 0; octave < 4; ++octave, weight *= 0.5f, place = 2.03f * place + 11.7f)
        sum += weight * (noise(place) - 0.5f);
    return glm::clamp(0.85f + 5.f * sum - 1.4f * outwards, 0.f, 1.f) * (1 - glm::smoothstep(0.8f, 1.f, outwards));
}

// The texture of each plane: a slice of the cloud.
class smoke_textures {
  public:
    smoke_textures() : texels_(static_cast<std::size_t>(smoke_planes * size * size))
    {
        const glm::vec3 scale(1.f / size, 1.f / size, 1.f / smoke_planes);
        for (int plane = 0; plane < smoke_planes; ++plane)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    texels_[index(plane, x, y)] = density((glm::vec3(x, y, plane) + 0.5f) * scale);
    }

    // Bilinear; 0 beyond the outermost texel centres, where the cloud has ended.
    float operator()(int plane, const glm::vec2& place) const
    {
        const glm::vec2 texel = place * float(size) - 0.5f, low = glm::floor(texel), t = texel - low;
        const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
        if (plane < 0 || plane >= smoke_planes || x < 0 || y < 0 || x + 1 >= size || y + 1 >= size) return 0;
        const auto row = [&](int j) {
            return glm::mix(texels_[index(plane, x, j)], texels_[index(plane, x + 1, j)], t.x);
        };
        return glm::mix(row(y), row(y + 1), t.y);
    }

  private:
    static constexpr int size = 128;
    static std::size_t index(int plane, int x, int y)
    {
        return static_cast<std::size_t>((plane * size + y) * size + x);
    }

    std::vector<float> texels_;
};

// Plane k of the smoke has texture coordinates from (2 k, 0) to (2 k + 1, 1).
float smoke_alpha(const glm::vec2& coordinates)
{
    static const smoke_textures textures;
    const float plane = std::floor(0.5f * coordinates.x);
    return textures(static_cast<int>(plane), {coordinates.x - 2 * plane, coordinates.y});
}

mesh smoke(const glm::vec3& centre, const glm::vec3& size)
{
    mesh result = painted("smoke", {0.75f, 0.75f, 0.78f});
    result.opacity = glm::vec3(smoke_opacity);
    result.alpha = smoke_alpha;
    const glm::vec3 right = glm::normalize(glm::cross(yard_light, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, yard_light);
    for (int k = 0; k < smoke_planes; ++k) {
        const float along = 0.5f - (static_cast<float>(k) + 0.5f) / float(smoke_planes);
        const glm::vec3 corner = centre + along * size.z * yard_light - 0.5f * size.x * right - 0.5f * size.y * up;
        const glm::vec2 first(2 * k, 0);
        add_textured_quad(result, corner, size.x * right, size.y * up, first, first + 1.f);
    }
    return result;
}

using places = std::initializer_list<glm::vec3>;

// A pipe through these places, with round bends.
mesh pipe(const char* name, const glm::vec3& albedo, places through, float radius)
{
    const std::span<const glm::vec3> corner(through.begin(), through.size());
    std::vector<glm::vec3> path{corner.front()};
    for (std::size_t i = 1; i + 1 < corner.size(); ++i) {
        const glm::vec3 back = 3 * radius * glm::normalize(corner[i - 1] - corner[i]);
        const glm::vec3 forth = 3 * radius * glm::normalize(corner[i + 1] - corner[i]);
        for (int k = 0; k <= 8; ++k) {
            const float angle = glm::half_pi<float>() * static_cast<float>(k) / 8;
            path.push_back(corner[i] + (1 - std::sin(angle)) * back + (1 - std::cos(angle)) * forth);
        }
    }
    path.push_back(corner.back());
    mesh result = painted(name, albedo);
    add_tube(result, path, radius, 24);
    return result;
}

// A window that stands free: panes of four colours between bars of lead.
void add_window(scene& target, const glm::vec3& place, const glm::vec2& size, float base)
{
    constexpr int columns = 3, rows = 4;
    constexpr float bar = 0.035f;
    const glm::vec2 pane = size / glm::vec2(columns, rows);
    mesh lead = painted("lead", {0.08f, 0.08f, 0.09f});
    for (int i = 0; i <= columns; ++i) {
        const float x = pane.x * static_cast<float>(i) - 0.5f * size.x, top = base + size.y + 0.5f * bar;
        const float foot = i == 0 || i == columns ? 0 : base;
        add_box(lead, upright(place + glm::vec3(x, 0.5f * (foot + top), 0), {bar, top - foot, bar}));
    }
    for (int i = 0; i <= rows; ++i)
        add_box(lead, upright(place + glm::vec3(0, base + pane.y * static_cast<float>(i), 0), {size.x, bar, bar}));
    target.meshes.push_back(std::move(lead));

    std::array glass{painted("red glass", {}), painted("amber glass", {}), painted("blue glass", {}),
                     painted("green glass", {})};
    glass[0].opacity = {0.08f, 0.93f, 0.95f}, glass[1].opacity = {0.05f, 0.38f, 0.93f};
    glass[2].opacity = {0.93f, 0.78f, 0.10f}, glass[3].opacity = {0.88f, 0.15f, 0.80f};
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const glm::vec3 corner(pane * glm::vec2(x, y) + glm::vec2(-0.5f * size.x, base), 0);
            add_quad(glass[static_cast<std::size_t>((x + y * 3) % 4)], place + corner, {pane.x, 0, 0}, {0, pane.y, 0});
        }
    for (mesh& some : glass) {
        some.albedo = 0.12f * (1.f - some.opacity);
        target.meshes.push_back(std::move(some));
    }
}

} // namespace

scene translucent_scene()
{
    scene result{"translucent", {}};
    const float left = -3.4f, right = 3.6f, back = -2;
    mesh walls = painted("walls", {0.50f, 0.44f, 0.36f}), coping = painted("coping", {0.36f, 0.34f, 0.32f});
    add_box(walls, upright({0.1f, 1.5f, back - 0.15f}, {7.3f, 3.0f, 0.3f}));
    add_box(walls, upright({left, 1.5f, -1.2f}, {0.3f, 3.0f, 1.6f}));
    add_box(coping, upright({0.1f, 3.04f, back - 0.15f}, {7.3f, 0.08f, 0.3f}));
    add_box(coping, upright({left, 3.04f, -1.2f}, {0.3f, 0.08f, 1.6f}));
    result.meshes.push_back(std::move(walls));
    result.meshes.push_back(std::move(coping));
    const auto along_wall = [&](const char* name, const glm::vec3& albedo, float height, float before, float radius) {
        return pipe(
            name, albedo,
            {{left, height, back + before}, {right - 0.4f, height, back + before}, {right - 0.4f, height, back}},
            radius);
    };
    result.meshes.push_back(
        pipe("red pipe", {0.52f, 0.03f, 0.02f},
             {{left, 2.55f, back + 0.22f}, {1.9f, 2.55f, back + 0.22f}, {1.9f, -0.1f, back + 0.22f}}, 0.10f));
    result.meshes.push_back(along_wall("yellow pipe", {0.60f, 0.40f, 0.02f}, 1.85f, 0.5f, 0.13f));
    result.meshes.push_back(along_wall("green pipe", {0.03f, 0.30f, 0.06f}, 0.95f, 0.14f, 0.08f));
    // From the camera, the shadow of the blue pipe in the smoke is a thin sheet.
    result.meshes.push_back(pipe("blue pipe", {0.02f, 0.07f, 0.50f},
                                 {{1.0f, 0.75f, back}, {0.05f, 0.75f, 0.3f}, {0.05f, -0.1f, 0.3f}}, 0.11f));
    result.meshes.push_back(ground({0.6f, 0, 0}, 40, 40, {0.34f, 0.33f, 0.31f}));
    add_window(result, {2.0f, 0, 0.6f}, {1.2f, 1.6f}, 0.12f);
    result.meshes.push_back(smoke({0.0f, 1.65f, -0.25f}, {3.3f, 2.9f, 2.0f}));
    return result;
}

stage translucent_stage(double aspect)
{
    stage result{translucent_scene(), {}, {}, {}};
    result.eye = perspective_view_from({-1.9, 2.3, 5.8}, {0.1, 1.3, -0.6}, bounds_of(result.world).corners(),
                                       glm::radians(36.0), aspect);
    result.light = orthographic_view(bounds{{-3.6f, 0, -2.3f}, {3.8f, 3.1f, 0.7f}}.corners(), yard_light);
    result.interests = {{"pipe", "wall behind the green pipe", {-0.35f, 0.72f, -2.0f}, paint::green},
                        {"silhouette", "smoke before the blue pipe", {0.62f, 1.42f, -0.3f}, {0.1f, 0.2f, 0.9f}},
                        {"smoke", "inside the smoke", {-0.1f, 2.0f, -0.35f}, paint::orange},
                        {"glass", "shadow of the window", {1.7f, 0, -0.1f}, {0.75f, 0.05f, 0.6f}}};
    return result;
}

stage smoke_close_up_stage(double aspect)
{
    stage result = translucent_stage(aspect);
    result.world.name = "smoke_close_up";
    result.eye = perspective_view_from({-0.7, 2.2, 1.9}, {0.0, 1.6, -0.35}, bounds_of(result.world).corners(),
                                       glm::radians(36.0), aspect);
    std::erase_if(result.interests, [](const point_of_interest& p) { return p.id == "pipe" || p.id == "glass"; });
    return result;
}

} // namespace gnomon::renderer
