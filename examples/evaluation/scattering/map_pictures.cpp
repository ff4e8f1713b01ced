#include "map_pictures.hpp"

#include "rectified_scene.hpp"
#include "renderer/output/image.hpp"

#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/storage/moments4.hpp>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const glm::vec3 cyan(0, 0.55f, 0.8f), orange(1, 0.3f, 0), faint(0.55f, 0.62f, 0.75f);

// A part of the plane across the light, from above: axes of the light, origin the camera.
class plane_picture {
  public:
    plane_picture(const scattering_view& view, int width)
        : scene_(view.scene()), frame_(rectified_scene(scene_, paper_options(rectified_source::texel)).frame)
    {
        const auto size = float(view.depths.centres.width);
        const glm::vec2 a = at_texel({0, 0}), b = at_texel({size, size});
        lower_ = glm::min(a, b), upper_ = glm::max(a, b);
        for (const glm::vec3& corner : scene_.corners) include(corner);
        include(glm::vec3(0));
        for (int i = 0; i <= arcs; ++i) include({on_circle(float(i) / arcs), 0});
        const glm::vec2 margin = 0.03f * (upper_ - lower_);
        lower_ -= margin, upper_ += margin;
        pixels_ = float(width) / (upper_.x - lower_.x);
        picture_ = picture(width, int(std::ceil((upper_.y - lower_.y) * pixels_)), glm::vec3(1));
        draw_depths(view.depths.centres);
    }

    // Edges of the view frustum, the far plane, and the sector of the bounds, with view rays.
    picture drawn()
    {
        const auto whole = [](const glm::vec3& v) { return glm::vec2(v); };
        for (int j = 1; j < 6; ++j)
            for (int i = 1; i < 6; ++i) {
                const float u = float(i) / 6, v = float(j) / 6;
                const std::array<glm::vec3, 4>& q = scene_.corners;
                line({0, 0}, whole(glm::mix(glm::mix(q[0], q[1], u), glm::mix(q[3], q[2], u), v)), faint, 0.5f);
            }
        for (std::size_t k = 0; k < 4; ++k) {
            line({0, 0}, whole(scene_.corners[k]), cyan, 1.2f);
            line(whole(scene_.corners[k]), whole(scene_.corners[(k + 1) % 4]), cyan, 1.2f);
        }
        for (int i = 0; i < arcs; ++i) line(on_circle(float(i) / arcs), on_circle(float(i + 1) / arcs), orange, 1.5f);
        if (!frame_.wraps())
            for (const float share : {0.0f, 1.0f}) line({0, 0}, on_circle(share), orange, 1.5f);
        return picture_;
    }

  private:
    static constexpr int arcs = 256;

    void include(const glm::vec3& point)
    {
        lower_ = glm::min(lower_, glm::vec2(point)), upper_ = glm::max(upper_, glm::vec2(point));
    }

    glm::vec2 at_texel(const glm::vec2& texel) const
    {
        const light_map& m = scene_.map;
        return {(texel.x - m.x) / m.texels_x, (texel.y - m.y) / m.texels_y};
    }
    glm::vec2 texel_at(const glm::vec2& place) const
    {
        const light_map& m = scene_.map;
        return {m.x + place.x * m.texels_x, m.y + place.y * m.texels_y};
    }

    glm::vec2 on_circle(float share) const
    {
        const float azimuth = frame_.azimuth_start + share * frame_.azimuth_length;
        return frame_.radius * glm::vec2(std::cos(azimuth), std::sin(azimuth));
    }

    // Near surfaces are bright; beyond the map all is white.
    void draw_depths(const image<float>& depths)
    {
        for (int y = 0; y < picture_.height; ++y)
            for (int x = 0; x < picture_.width; ++x) {
                const glm::vec2 place(lower_.x + (float(x) + 0.5f) / pixels_, upper_.y - (float(y) + 0.5f) / pixels_);
                const glm::vec2 texel = texel_at(place);
                const int i = int(std::floor(texel.x)), j = int(std::floor(texel.y));
                if (i < 0 || j < 0 || i >= depths.width || j >= depths.height) continue;
                picture_(x, y) = glm::vec3(0.06f + 0.5f * (0.5f - 0.5f * depths(i, j)));
            }
    }

    void line(const glm::vec2& from, const glm::vec2& to, const glm::vec3& colour, float half_width)
    {
        const auto pixel = [&](const glm::vec2& place) {
            return glm::vec2((place.x - lower_.x) * pixels_, (upper_.y - place.y) * pixels_);
        };
        const glm::vec2 a = pixel(from), b = pixel(to), along = b - a;
        const float square = std::max(glm::dot(along, along), 1e-6f);
        const glm::vec2 least = glm::min(a, b) - 2.0f, most = glm::max(a, b) + 2.0f;
        for (int y = std::max(int(least.y), 0); y <= std::min(int(most.y), picture_.height - 1); ++y)
            for (int x = std::max(int(least.x), 0); x <= std::min(int(most.x), picture_.width - 1); ++x) {
                const glm::vec2 centre(float(x) + 0.5f, float(y) + 0.5f);
                const float share = glm::clamp(glm::dot(centre - a, along) / square, 0.0f, 1.0f);
                const float cover = glm::clamp(half_width + 0.5f - glm::length(centre - a - share * along), 0.0f, 1.0f);
                picture_(x, y) = glm::mix(picture_(x, y), colour, cover);
            }
    }

    scattering_scene scene_;
    rectified_frame frame_;
    glm::vec2 lower_{0}, upper_{0};
    float pixels_ = 1;
    picture picture_;
};

// The first three moments as red, green and blue, from -1 (b1, b3) or 0 (b2) to 1.
picture moments_picture(map_view<const moments4_float::texel> map)
{
    picture result(int(map.width), int(map.height));
    for (std::size_t y = 0; y < map.height; ++y)
        for (std::size_t x = 0; x < map.width; ++x) {
            const channels4<float> c = moments4_float::decode(map(x, y));
            const glm::vec3 shown(0.5f + 0.5f * c.c1, c.c2, 0.5f + 0.5f * c.c3);
            result(int(x), int(y)) = shown * shown; // of the picture's codes
        }
    return result;
}

const std::vector<std::pair<std::string, std::string>> key_of_bounds{
    {"#ff9500", "bounds of radius and azimuth"}, {"#00c4e7", "edges of the view frustum"}, {"#c4cee1", "view rays"}};

shown_picture drawn_bounds(const scattering_view& view, const std::filesystem::path& folder, const std::string& name,
                           const std::string& caption)
{
    const std::string file = "bounds-" + name + ".png";
    write_png(folder / file, plane_picture(view, 480).drawn());
    return {file,
            "The light's map, grey by depth, with the view frustum and the sector that bounds its rays: " + caption,
            caption};
}

} // namespace

block rectification_block(const scattering_view& view, const std::filesystem::path& folder)
{
    using format = moments4_float;
    const scattering_scene scene = view.scene();
    const rectified_scene rectified(scene, paper_options(rectified_source::texel));
    std::vector<format::texel> texels(scene.columns * scene.rows);
    const map_view<format::texel> map(texels, scene.columns, scene.rows);
    rectified.rectify<format>(map);
    write_png(folder / "rectified.png", moments_picture(map));
    transmittance_prefix<format>(map, rectified.rows, {0, scene.rows});
    write_png(folder / "prefix.png", moments_picture(map));
    pictures_block result{
        .title = "From the shadow map to prefix averages",
        .text =
            "After Figure 13 of the paper. Columns of a rectified map are distances from the camera across the light, "
            "rows are "
            "angles around the light, and depth is the angle between a view ray and the light, so that a view ray is "
            "the begin of a row at one depth. Red, green and blue are the first three moments. Each texel of the last "
            "map is the weighted average of all texels to its left.",
        .columns = 3,
        .pictures = {drawn_bounds(view, folder, "rectified", "radius and azimuth in the light's map")}};
    result.pictures.push_back(
        {"rectified.png", "Rectified map of moments: silhouettes of windows and walls along rows", "rectified map"});
    result.pictures.push_back(
        {"prefix.png", "Prefix averages of the rectified map, smooth along rows", "prefix averages"});
    result.key = key_of_bounds;
    return result;
}

block bounds_block(const scattering_view& outside, const scattering_view& inside, const std::filesystem::path& folder)
{
    pictures_block result{.title = "Bounds of the view",
                          .text =
                              "After Figure 21 of the paper: the view frustum as the light sees it. Where the "
                              "direction of the light, or its "
                              "opposite, is in view, azimuths are a full turn.",
                          .columns = 2,
                          .pictures = {drawn_bounds(outside, folder, "outside", "the light is outside the view"),
                                       drawn_bounds(inside, folder, "inside", "the light is inside the view")}};
    result.key = key_of_bounds;
    return result;
}

} // namespace gnomon::evaluation
