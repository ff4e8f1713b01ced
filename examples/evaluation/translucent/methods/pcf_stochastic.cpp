// Percentage-closer filtering over stochastic transparency (Enderton et al. 2010).
#include "evaluation/core/percentage_closer.hpp"
#include "stochastic.hpp"

#include <algorithm>

namespace gnomon::evaluation {

namespace {

class stochastic_depth_map final : public translucent_map {
  public:
    stochastic_depth_map(const translucent_occluders& occluders, std::span<const float> taps, const build_settings& how)
        : depths_(stochastic_depths(occluders, how)), taps_(taps)
    {}

    std::size_t bytes() const override { return depths_.pixels.size() * sizeof(depths_.pixels[0]); }

    void intensities(std::span<const map_receiver> where, colour, bound, std::span<float> result) const override
    {
        look_up(where, result);
    }

    std::vector<timed_look_up> timed(std::span<const map_receiver> where) const override
    {
        const timed_run run{where.size(), [this, where](std::span<float> result) { look_up(where, result); }};
        return {{1, run, run}};
    }

  private:
    void look_up(std::span<const map_receiver> where, std::span<float> result) const
    {
        std::ranges::transform(where, result.begin(), [&](const map_receiver& r) {
            return percentage_closer_intensity<float>(depths_, r, taps_);
        });
    }

    depth_map depths_;
    std::span<const float> taps_;
};

class stochastic_filter final : public translucent_method {
  public:
    stochastic_filter()
        : translucent_method({.id = "pcf_stochastic",
                              .family = "pcf",
                              .label = "PCF, stochastic",
                              .order = 10,
                              .map = "depths",
                              .format = {"depth_4_samples", "4 samples of 32 bit depth", sizeof(depth_map::pixels[0])}},
                             {.random = true, .between_bounds = false})
    {}

    std::unique_ptr<translucent_map> build(const translucent_occluders& occluders, std::span<const float> taps,
                                           const build_settings& how) const override
    {
        return std::make_unique<stochastic_depth_map>(occluders, taps, how);
    }
};

const registered<stochastic_filter> entry;

} // namespace

} // namespace gnomon::evaluation
