// Methods of soft shadows: a map is built from the depths that a light with an area sees from its middle, and a look-up
// searches it for blockers, estimates the width of the penumbra and filters the map over that width (Peters et al. 2017,
// Sec. 4). A method on a file of its own is a class on soft_method; look_up.hpp has the steps that most share.
#pragma once

#include "evaluation/core/depth_map.hpp"
#include "evaluation/core/method.hpp"

#include <gnomon/filters/depth_bias.h>
#include <gnomon/soft/penumbra.h>
#include <gnomon/soft/summed_area.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// Depths of a shadow map: four samples in each texel, and one at each texel's centre.
struct soft_depths {
    const depth_map& samples;
    const renderer::image<std::array<float, 1>>& centres;
};

// All that a look-up may use: the place in texels, signed depth without a bias, and how depth changes per texel on the
// receiver's plane. Floats or packs.
template <class Real> struct soft_place {
    Real x, y, depth, slope_x, slope_y;
};
using soft_receiver = soft_place<float>;

// Widths along both axes of the map, in texels.
template <class Real> struct soft_widths {
    Real x, y;
};

// The area of a light as its shadow map sees it, and the region that a look-up may search for blockers.
struct soft_light {
    bool is_local = false;
    soft_widths<float> texels{}; // directional: of the penumbra per signed depth; local: of the light, at distance 1
    float near_distance = 0, far_distance = 1;
    float map_width = 0, map_height = 0;
    float widest_search = 27; // along each axis; penumbrae are no wider

    // The most texels that a search on the grid of texels covers.
    float most_texels() const { return (std::ceil(widest_search) + 1) * (std::ceil(widest_search) + 1); }

    // Widths of the penumbra, from 1 texel to the widest search.
    template <class Real> soft_widths<Real> penumbra(Real receiver, Real blocker) const
    {
        const auto width = [&](float scale) {
            return is_local ? penumbra_local(receiver, blocker, Real(near_distance), Real(far_distance), Real(scale),
                                             Real(widest_search))
                            : penumbra_directional(receiver, blocker, Real(scale), Real(widest_search));
        };
        return {width(texels.x), width(texels.y)};
    }

    // Around all that blockers anywhere may cover of the light, and around what the penumbra filters. A look-up clips both to
    // the map, and makes whole texels of the first.
    template <class Real> summed_area_rectangle<Real> search_rectangle(const soft_place<Real>& where) const
    {
        return filter_rectangle(where, penumbra(where.depth, Real(-1)));
    }
    template <class Real>
    static summed_area_rectangle<Real> filter_rectangle(const soft_place<Real>& where, const soft_widths<Real>& widths)
    {
        return summed_area_around(where.x, where.y, widths.x, widths.y);
    }
    template <class Real> summed_area_rectangle<Real> clipped(const summed_area_rectangle<Real>& rectangle) const
    {
        return summed_area_clip(rectangle, Real(map_width), Real(map_height), Real(most_texels()));
    }
};

// The receiver's depth without the most that its plane rises within the filter, whose outermost texels lie up to one texel
// beyond the rectangle.
template <class Real> Real biased_depth(const soft_place<Real>& where, const soft_widths<Real>& widths)
{
    const gnomon::depth_gradient<Real> gradient{where.slope_x, where.slope_y};
    const Real reach_x = Real(0.5) * widths.x + Real(1), reach_y = Real(0.5) * widths.y + Real(1);
    return where.depth - depth_bias_receiver_plane(gradient, reach_x, reach_y, Real(2));
}

// Shares of receivers whose look-up ends with the search, in the umbra and in full light.
struct skipped_shares {
    double umbra = 0, lit = 0;
};

class soft_shadow_map {
  public:
    virtual ~soft_shadow_map() = default;

    virtual std::size_t bytes() const = 0;

    // Shadow intensity of one receiver after the other.
    virtual void intensities(std::span<const soft_receiver> where, std::span<float> result) const = 0;

    // Runs to time: the kernels alone, from values that have been fetched, and with the look-ups; receiver by receiver, and
    // by packs of them where the method has kernels for packs. The map and the receivers outlive what is returned.
    virtual std::vector<timed_look_up> timed(std::span<const soft_receiver> where) const = 0;

    // Of a method that may end with the search.
    virtual std::optional<skipped_shares> skipped(std::span<const soft_receiver>) const { return {}; }
};

class soft_method : public method {
  public:
    explicit soft_method(method_facts facts, float its_search = 27)
        : method(std::move(facts)), widest_search(its_search)
    {}

    // The depths outlive the map.
    virtual std::unique_ptr<soft_shadow_map> build(const soft_depths& depths, const soft_light& light) const = 0;

    const float widest_search; // in texels along each axis, as the scenes use it
};

} // namespace gnomon::evaluation
