// After Figure 2 of Peters et al. 2017: one depth distribution, the sharp bounds that its moments set for every
// receiver, and some of the distributions that touch them.
#include "evaluation/core/driver.hpp"
#include "renderer/output/file.hpp"

#include <gnomon/filters/variance.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

namespace {

using json = nlohmann::ordered_json;

struct surface {
    double nearest, farthest, share;
};

// What a filter region sees of three surfaces, each of them at a slant.
constexpr std::array surfaces{surface{-0.75, -0.6, 0.3}, surface{-0.15, 0.1, 0.35}, surface{0.45, 0.65, 0.35}};
constexpr int samples_of_surface = 32;

constexpr std::array receivers_drawn{-0.35, 0.0, 0.3, 0.75};
constexpr int steps = 400; // of receivers from -1 to 1

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

json representation(double z_f, const auto& depths, const auto& weights)
{
    return {{"receiver", z_f}, {"depths", depths}, {"weights", weights}};
}

// Two moments, from Cantelli's inequality and its mirror image.
struct two_moments {
    variance_moments<double> b;

    hamburger_bounds<double> bounds(double z_f) const
    {
        const double lower = cantelli_lower(b, z_f, 0.0);
        const double upper = 1 - cantelli_lower(variance_moments<double>{-b.mean, b.square}, -z_f, 0.0);
        return {lower, upper, upper - lower};
    }
    json touching(double z_f) const
    {
        const double weight = bounds(z_f).weight;
        const double other = (b.mean - weight * z_f) / (1 - weight);
        return representation(z_f, std::array{z_f, other}, std::array{weight, 1 - weight});
    }
};

struct four_moments {
    hankel4<double> b;

    hamburger_bounds<double> bounds(double z_f) const { return hamburger4_bounds(b, z_f); }
    json touching(double z_f) const
    {
        const auto d = hamburger4_distribution(b, z_f);
        return representation(z_f, std::array{d.depth0, d.depth1, d.depth2},
                              std::array{d.weight0, d.weight1, d.weight2});
    }
};

struct six_moments {
    hankel6<double> b;

    hamburger_bounds<double> bounds(double z_f) const { return hamburger6_bounds(b, z_f); }
    json touching(double z_f) const
    {
        const auto d = hamburger6_distribution(b, z_f);
        return representation(z_f, std::array{d.depth0, d.depth1, d.depth2, d.depth3},
                              std::array{d.weight0, d.weight1, d.weight2, d.weight3});
    }
};

json facts_of(int count, const auto& moments)
{
    json facts{{"moments", count}};
    for (int i = 0; i <= steps; ++i) {
        const double z_f = 2.0 * i / steps - 1;
        const auto bounds = moments.bounds(z_f);
        facts["receivers"].push_back(z_f);
        facts["lower"].push_back(bounds.lower);
        facts["upper"].push_back(bounds.upper);
    }
    for (const double z_f : receivers_drawn) facts["representations"].push_back(moments.touching(z_f));
    return facts;
}

// Bounds and representations of one depth distribution from 2, 4 and 6 moments, after the paper's Figure 2.
void bounds(const settings& how)
{
    progress("bounds", "one depth distribution, bounds from 2, 4 and 6 moments");
    const region r = seen_region();
    const moments6<double>& b = r.moments;
    const json facts{{"depths", r.depths},
                     {"weights", r.weights},
                     {"bounds",
                      {facts_of(2, two_moments{{b.b1, b.b2}}),
                       facts_of(4, four_moments{hankel4_from_moments(moments4<double>{b.b1, b.b2, b.b3, b.b4})}),
                       facts_of(6, six_moments{hankel6_from_moments(b)})}}};
    renderer::write_file(how.out / "gallery" / "bounds" / "facts.json", facts.dump(1));
}

const registered<driver> entry{driver{.id = "bounds", .label = "Bounds from moments", .order = 30, .run = bounds}};

} // namespace

} // namespace gnomon::evaluation
