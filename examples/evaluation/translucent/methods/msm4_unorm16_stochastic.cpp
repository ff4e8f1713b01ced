// Moment shadow maps of 64 bits over stochastic transparency: nothing is blended, so the bias is that of the filter alone.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"
#include "stochastic.hpp"

namespace gnomon::evaluation {

namespace {

struct stochastic_rule {
    using format = moments4_unorm16;
    template <class Real> using channels = format::channels<Real>;

    template <class Real> static Real lower(const channels<Real>& c, Real, Real z_f)
    {
        return format::filtered_intensity(c, z_f);
    }
    template <class Real> static hamburger_bounds<Real> bounds(const channels<Real>& c, Real, Real z_f)
    {
        return hamburger4_bounds(format::filtered_factor(c), z_f);
    }
};

class stochastic_method final : public translucent_method {
  public:
    stochastic_method()
        : translucent_method({.id = "msm4_unorm16_stochastic",
                              .family = "msm4",
                              .label = "MSM 64 bit, stochastic",
                              .order = 160,
                              .map = translucent_map_kind->id,
                              .format = facts_of_format<moments4_unorm16>()},
                             {.random = true})
    {}

    std::unique_ptr<translucent_map> build(const translucent_occluders& occluders, std::span<const float> taps,
                                           const build_settings& how) const override
    {
        return std::make_unique<blended_map<stochastic_rule>>(stochastic_depths(occluders, how), taps);
    }
};

const registered<stochastic_method> entry;

} // namespace

} // namespace gnomon::evaluation
