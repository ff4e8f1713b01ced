#include "rectified_scene.hpp"

#include "rectified_occluders.hpp"

#include <gnomon/passes/rectified_look_up.hpp>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::evaluation {

namespace {

// The corners of the plane at a share of the far plane's distance.
rectified_corners<float> corners_of(const scattering_scene& scene, float share)
{
    const auto corner = [&](std::size_t k) {
        const glm::vec3 end = share * scene.corners[k];
        return rectified_corner<float>{end.x, end.y, end.z};
    };
    return {corner(0), corner(1), corner(2), corner(3)};
}

// The look-up of rectified_look_up.hpp, in double, on counts of occluders in place of channels.
template <class Texel> class counted_look_up {
  public:
    counted_look_up(const rectified_scene& map, const renderer::image<Texel>& texels) : map_(map), texels_(texels) {}

    double visibility(const rectified_ray& ray) const
    {
        const std::size_t height = map_.rows.size();
        const auto levels = std::size_t(std::bit_width(std::max(map_.columns, height)));
        const gnomon::detail::rectified_place at =
            gnomon::detail::rectified_place_of(map_.frame, ray.position, map_.columns, height);
        const gnomon::detail::neighbours n = gnomon::detail::neighbours_of<border_mode::clamp>(ray.level, levels);
        double result = at_level(ray, at, n.lower);
        if (n.fraction > 0) result += double(n.fraction) * (at_level(ray, at, n.upper) - result);
        return 1 - result;
    }

  private:
    double at_level(const rectified_ray& ray, const gnomon::detail::rectified_place& at, std::size_t level) const
    {
        const std::size_t size = std::size_t(1) << level, height = map_.rows.size();
        const float scale = 1 / float(size);
        const std::size_t rows = std::max<std::size_t>(height >> level, 1);
        const gnomon::detail::neighbours ny = gnomon::detail::rectified_rows_of(at.y * scale, rows, map_.frame.wraps());
        const auto row = [&](std::size_t v) {
            double sum = 0;
            for (std::size_t j = 0; j < size; ++j) sum += of_row(ray, at.x, v * size + j, size);
            return sum / double(size);
        };
        const double lower = row(ny.lower);
        return ny.fraction > 0 ? lower + double(ny.fraction) * (row(ny.upper) - lower) : lower;
    }

    // The share in shadow between the centres of two texels of a level, each `size` texels wide.
    double of_row(const rectified_ray& ray, float x, std::size_t v, std::size_t size) const
    {
        const rectified_row& row = map_.rows[v];
        const float z_f = rectified_depth_of(map_.frame.depth, ray.position.polar, row.range);
        const gnomon::detail::neighbours n = gnomon::detail::neighbours_of<border_mode::clamp>(
            x / float(size) - 0.5f, std::max<std::size_t>(map_.columns / size, 1));
        double weight = row.decay == 0 ? 1 : in_fog(row, 0), all = 0, shadowed = 0, lower = 0, upper = 0;
        for (std::size_t u = 0; u < (n.upper + 1) * size; ++u) {
            all += weight;
            shadowed += weight * double(texels_(int(u), int(v)).share_before(z_f));
            weight = row.decay == 0 ? weight * double(row.factor) : in_fog(row, u + 1);
            if (u / size == n.lower) lower += shadowed / all;
            if (u / size == n.upper) upper += shadowed / all;
        }
        const double width = double(size), before = (double(n.lower) + 0.5) * width + 0.5;
        const double share = gnomon::detail::rectified_share(before, width, double(n.fraction),
                                                             double(row.optical_depth), double(row.decay));
        return (lower + share * (upper - lower)) / width;
    }

    // The weight of a texel of a row in height fog.
    static double in_fog(const rectified_row& row, std::size_t u)
    {
        return height_fog_weight(double(u), double(u + 1), double(row.decay), double(row.optical_depth));
    }

    const rectified_scene& map_;
    const renderer::image<Texel>& texels_;
};

// occluders(u, v) returns those of a texel.
std::vector<float> counted(const rectified_scene& map, std::span<const view_segment> where, const auto& occluders)
{
    renderer::image<decltype(occluders(0, 0))> texels(int(map.columns), int(map.rows.size()));
    tbb::parallel_for(0, texels.height, [&](int v) {
        for (int u = 0; u < texels.width; ++u) texels(u, v) = occluders(std::size_t(u), std::size_t(v));
    });
    const counted_look_up look_up(map, texels);
    std::vector<float> result(where.size());
    tbb::parallel_for(std::size_t(0), where.size(),
                      [&](std::size_t i) { result[i] = float(look_up.visibility(map.ray(rays_of<float>(where, i)))); });
    return result;
}

} // namespace

std::string id_of(const rectified_options& options)
{
    constexpr const char* sources[] = {"texel", "texels", "moments"};
    return fmt::format("{}_{}_{}{}", sources[static_cast<int>(options.source)],
                       options.depth == rectified_depth::polar ? "polar" : "cosine",
                       options.range_per_row ? "row" : "frustum", options.fitted ? "_fitted" : "");
}

rectified_scene::rectified_scene(const scattering_scene& scene, const rectified_options& options)
    : columns(scene.columns), rows(scene.rows), scene_(scene), options_(options)
{
    const rectified_corners<float> far_plane = corners_of(scene, options.fitted ? scene.visible : 1);
    const rectified_frustum<float> bounds = rectified_frustum_from_corners(far_plane);
    frame = rectified_frame_of(bounds, options.depth);
    row_angle_ = frame.azimuth_length / float(rows.size());
    column_width_ = rectified_radius_step(frame, columns);
    const rectified_fog fog{scene.falloff, scene.up.x, scene.up.y, scene.up.z};
    if (options.range_per_row) rectified_rows(frame, far_plane, scene.extinction, columns, rows, fog);
    else rectified_rows(frame, bounds, scene.extinction, columns, rows, fog);
}

std::vector<float> rectified_scene::exact(std::span<const view_segment> where) const
{
    const rectified_plan plan{scene_.map, frame, rows, columns};
    const auto by = [&](const auto& occluders, const auto& source) {
        return counted(*this, where, [&](std::size_t u, std::size_t v) { return occluders(plan, source, u, v); });
    };
    switch (options_.source) {
        case rectified_source::texel:
            return by(occluders_of_texel, scene_.depths.plain());
        case rectified_source::texels:
            return by(occluders_of_texels, scene_.depths.plain());
        default:
            return by(occluders_of_moments, scene_.depths.filtered());
    }
}

} // namespace gnomon::evaluation
