// Occluders of the texels of a rectified map, one by one with their weights, in double: the averages of passes/rectify.hpp.
#pragma once

#include <gnomon/passes/rectify.hpp>
#include <gnomon/storage/moments4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace gnomon::evaluation {

template <std::size_t count> struct weighted_occluders {
    std::array<float, count> depths, weights;

    float share_before(float z_f) const
    {
        float result = 0;
        for (std::size_t i = 0; i < count; ++i) result += depths[i] < z_f ? weights[i] : 0;
        return result;
    }
};

// A rectified map to be, of so many columns.
struct rectified_plan {
    const light_map& light;
    const rectified_frame& frame;
    std::span<const rectified_row> rows;
    std::size_t columns;

    double step() const { return double(frame.radius) / double(columns); }
    double turn() const { return double(frame.azimuth_length) / double(rows.size()); }

    // Depths of the shadow map from `far_plane` on shadow nothing.
    float mapped(std::size_t v, double radius, double depth, double far_plane = 1) const
    {
        if (!(depth < far_plane)) return 1;
        const double z = (std::max(depth, -1.0) - double(light.z)) / double(light.depths);
        const double middle = double(rows[v].range.middle), scale = double(rows[v].range.scale);
        const double from_middle =
            frame.depth == rectified_depth::polar ? middle - std::atan2(radius, z) : z / std::hypot(radius, z) - middle;
        return float(std::clamp(from_middle * scale, -1.0, 1.0));
    }
};

// A texel's light ray in the shadow map, and widths of the texel there along both axes.
struct rectified_texel {
    rectified_texel(const rectified_plan& plan, std::size_t u, std::size_t v)
        : radius((double(u) + 0.5) * plan.step()), x(double(plan.light.x)), y(double(plan.light.y))
    {
        const double along_x = double(plan.rows[v].cosine), along_y = double(plan.rows[v].sine);
        const double across = radius * plan.turn(), texels_x = double(plan.light.texels_x),
                     texels_y = double(plan.light.texels_y);
        x += radius * along_x * texels_x, y += radius * along_y * texels_y;
        width_x = (std::abs(along_x) * plan.step() + std::abs(along_y) * across) * std::abs(texels_x);
        width_y = (std::abs(along_y) * plan.step() + std::abs(along_x) * across) * std::abs(texels_y);
    }
    double radius, x, y, width_x, width_y;
};

inline double depth_at(map_view<const float> depths, double x, double y)
{
    const bool inside = x >= 0 && y >= 0 && x < double(depths.width) && y < double(depths.height);
    return inside ? double(depths(std::size_t(x), std::size_t(y))) : 1;
}

// Of rectify().
inline weighted_occluders<1> occluders_of_texel(const rectified_plan& plan, map_view<const float> depths, std::size_t u,
                                                std::size_t v)
{
    const rectified_texel at(plan, u, v);
    return {{plan.mapped(v, at.radius, depth_at(depths, at.x, at.y))}, {1}};
}

// Of rectify_filtered().
inline weighted_occluders<16> occluders_of_texels(const rectified_plan& plan, map_view<const float> depths,
                                                  std::size_t u, std::size_t v)
{
    struct spline {
        spline(double place, double width) : spacing(std::max(0.5 * width, 1.0))
        {
            const double t = place / spacing - 0.5, first = std::floor(t) - 1;
            for (std::size_t k = 0; k < 4; ++k) {
                const double distance = std::abs(t - (first + double(k)));
                const double outer = std::max(2 - distance, 0.0), inner = std::max(1 - distance, 0.0);
                at[k] = (first + double(k) + 0.5) * spacing;
                weight[k] = (outer * outer * outer - 4 * inner * inner * inner) / 6;
            }
        }
        double spacing;
        std::array<double, 4> at, weight;
    };
    const rectified_texel at(plan, u, v);
    const spline x(at.x, at.width_x), y(at.y, at.width_y);
    weighted_occluders<16> result;
    for (std::size_t k = 0; k < 16; ++k) {
        result.depths[k] = plan.mapped(v, at.radius, depth_at(depths, x.at[k % 4], y.at[k / 4]));
        result.weights[k] = float(x.weight[k % 4] * y.weight[k / 4]);
    }
    return result;
}

// Of rectify_moments(), from a map of four moments in 64 bits.
inline weighted_occluders<2> occluders_of_moments(const rectified_plan& plan,
                                                  mip_view<const moments4_unorm16::texel> moments, std::size_t u,
                                                  std::size_t v)
{
    using source = moments4_unorm16;
    constexpr moments_noise noise = stored_noise<source>;
    const rectified_texel at(plan, u, v);
    const float texels = std::max(std::abs(plan.light.texels_x), std::abs(plan.light.texels_y));
    const float level =
        rectified_level(rectified_footprint(float(at.radius), float(plan.step()), float(plan.turn()), texels));
    const moments4<float> b =
        source::to_moments(trilinear<source>(moments, float(at.x), float(at.y), level, border_mode::lit));
    const distribution2<float> d = two_point_distribution(
        b.b1, b.b2, two_point_third_moment(b.b1, b.b2, b.b3, noise.channel), noise.least_variance);
    const double far_plane = 1 - std::sqrt(double(noise.least_variance));
    return {{plan.mapped(v, at.radius, double(d.depth1), far_plane),
             plan.mapped(v, at.radius, double(d.depth2), far_plane)},
            {d.weight1, d.weight2}};
}

} // namespace gnomon::evaluation
