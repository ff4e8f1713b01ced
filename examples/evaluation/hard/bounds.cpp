// After Figure 2 of Peters et al. 2017: one depth distribution, the sharp bounds that its moments set for every
// receiver, and some of the distributions that touch them.
#include "evaluation/core/blocks.hpp"
#include "evaluation/core/driver.hpp"

#include <gnomon/filters/variance.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

namespace {

struct surface {
    double nearest, farthest, share;
};

// The depths of three slanted surfaces in a filter region.
constexpr std::array surfaces{surface{-0.75, -0.6, 0.3}, surface{-0.15, 0.1, 0.35}, surface{0.45, 0.65, 0.35}};
constexpr int samples_of_surface = 32;

constexpr std::array<std::pair<double, const char*>, 4> receivers_drawn{
    {{-0.35, "#d62728"}, {0.0, "#ff7f0e"}, {0.3, "#2ca02c"}, {0.75, "#1f77b4"}}};
constexpr int receiver_steps = 400; // of receivers from -1 to 1

struct region {
    std::vector<double> depths, weights;
    moments6<double> moments{};
};

region seen_region()
{
    region r;
    for (const surface& s : surfaces)
        for (int i = 0; i < samples_of_surface; ++i) {
            const double z = s.nearest + (s.farthest - s.nearest) * (i + 0.5) / samples_of_surface;
            const double weight = s.share / samples_of_surface;
            r.depths.push_back(z);
            r.weights.push_back(weight);
            r.moments = moments6_add(r.moments, moments6_from_depth(z), weight);
        }
    return r;
}

// Depths and their weights.
using distribution = std::vector<std::pair<double, double>>;

// Two moments, from Cantelli's inequality and its mirror image.
struct two_moments {
    variance_moments<double> b;

    hamburger_bounds<double> bounds(double z_f) const
    {
        const double lower = cantelli_lower(b, z_f, 0.0);
        const double upper = 1 - cantelli_lower(variance_moments<double>{-b.mean, b.square}, -z_f, 0.0);
        return {lower, upper, upper - lower};
    }
    distribution touching(double z_f) const
    {
        const double weight = bounds(z_f).weight;
        const double other = (b.mean - weight * z_f) / (1 - weight);
        return {{z_f, weight}, {other, 1 - weight}};
    }
};

struct four_moments {
    hankel4<double> b;

    hamburger_bounds<double> bounds(double z_f) const { return hamburger4_bounds(b, z_f); }
    distribution touching(double z_f) const
    {
        const auto d = hamburger4_distribution(b, z_f);
        return {{d.depth0, d.weight0}, {d.depth1, d.weight1}, {d.depth2, d.weight2}};
    }
};

struct six_moments {
    hankel6<double> b;

    hamburger_bounds<double> bounds(double z_f) const { return hamburger6_bounds(b, z_f); }
    distribution touching(double z_f) const
    {
        const auto d = hamburger6_distribution(b, z_f);
        return {{d.depth0, d.weight0}, {d.depth1, d.weight1}, {d.depth2, d.weight2}, {d.depth3, d.weight3}};
    }
};

// The distribution function, from 0 before all depths to 1 behind them.
series steps_of(std::string label, std::string colour, distribution d)
{
    std::ranges::sort(d);
    series result{.label = std::move(label), .colour = std::move(colour), .style = style::steps, .points = {{-1.2, 0}}};
    result.labelled = false;
    double sum = 0;
    for (const auto& [z, weight] : d) result.points.push_back({z, sum += weight});
    result.points.push_back({1.2, sum});
    return result;
}

panel panel_of(int count, const auto& moments, const region& r)
{
    panel result{.title = fmt::format("{} moments", count),
                 .x = {.label = "depth", .least = -1, .most = 1},
                 .y = {.label = "shadow intensity", .least = -0.02, .most = 1.02}};
    series band{.label = "between the bounds", .colour = "#5b7ea8", .style = style::band};
    band.labelled = false;
    for (int i = 0; i <= receiver_steps; ++i) {
        const double z_f = 2.0 * i / receiver_steps - 1;
        const hamburger_bounds<double> found = moments.bounds(z_f);
        band.points.push_back({z_f, found.lower, found.upper});
    }
    result.series.push_back(std::move(band));
    for (std::size_t k = 0; k < receivers_drawn.size(); ++k) {
        const auto& [z_f, colour] = receivers_drawn[k];
        result.series.push_back(
            steps_of(fmt::format("touches both bounds at {:g}", z_f), colour, moments.touching(z_f)));
        series rule{.label = fmt::format("receiver at {:g}", z_f), .colour = colour, .style = style::rule};
        rule.points = {{z_f, std::numeric_limits<double>::quiet_NaN()}};
        rule.labelled = false;
        rule.dashed = true;
        result.series.push_back(std::move(rule));
    }
    distribution seen;
    for (std::size_t i = 0; i < r.depths.size(); ++i) seen.emplace_back(r.depths[i], r.weights[i]);
    result.series.push_back(steps_of("the region itself", "#222222", seen));
    return result;
}

// The mean width between the bounds.
double mean_width(const panel& p)
{
    double sum = 0;
    for (const std::vector<double>& point : p.series.front().points) sum += point[2] - point[1];
    return sum / double(p.series.front().points.size());
}

// Bounds and representations of one depth distribution from 2, 4 and 6 moments, after the paper's Figure 2.
void bounds(const settings& how)
{
    progress("bounds", "one depth distribution, bounds from 2, 4 and 6 moments");
    const region r = seen_region();
    const moments6<double>& b = r.moments;
    chart_block chart{
        .title = "Bounds on the shadow of every receiver",
        .name = "bounds",
        .alt = {},
        .caption = "After Figure 2 of Peters et al. 2017. Receivers are dashed.",
        .panels = {panel_of(2, two_moments{{b.b1, b.b2}}, r),
                   panel_of(4, four_moments{hankel4_from_moments(moments4<double>{b.b1, b.b2, b.b3, b.b4})}, r),
                   panel_of(6, six_moments{hankel6_from_moments(b)}, r)}};
    chart.alt = fmt::format(
        "Lower and upper bounds on the distribution of three slanted surfaces, over depth. The mean width between the "
        "bounds is {:.3f} from two moments, {:.3f} from four and {:.3f} from six.",
        mean_width(chart.panels[0]), mean_width(chart.panels[1]), mean_width(chart.panels[2]));
    write_page(
        how.folder("bounds"),
        {.driver = "bounds",
         .title = "Bounds from moments",
         .family = "hard",
         .summary = "Why a few moments are enough for a shadow, and why more of them leak less.",
         .blocks = {
             text_block{.text = "A filterable shadow map stores a few moments of the depths in a filter region "
                                "(black). Moments do not tell how much of the region lies in front of a receiver, "
                                "but they set sharp bounds on that share. A surface is shaded with the lower "
                                "bound, which never darkens the surface without cause. For each receiver there is "
                                "a distribution of few depths that has the same moments and touches both bounds; "
                                "the kernels find just that one. The more moments, the tighter the bounds."},
             chart}});
}

const registered<driver> entry{driver{.id = "bounds", .label = "Bounds from moments", .order = 30, .run = bounds}};

} // namespace

} // namespace gnomon::evaluation
