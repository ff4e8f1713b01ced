// Percentage-closer filtering under the weights that filterable maps are filtered with. There is no filterable map: the
// look-up is the kernel.
#include "evaluation/core/method.hpp"
#include "evaluation/core/percentage_closer.hpp"

#include <memory>
#include <span>
#include <vector>

namespace gnomon::evaluation {

namespace {

const registered<map_kind> depths_kind{map_kind{.id = "depths", .label = "depths, not filtered", .order = 10}};

class depths_themselves final : public shadow_map {
  public:
    depths_themselves(const depth_map& depths, std::span<const float> taps) : depths_(depths), taps_(taps) {}

    std::size_t bytes() const override { return depths_.pixels.size() * sizeof(depths_.pixels[0]); }

    void intensities(std::span<const map_receiver> where, std::span<float> result) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i)
            result[i] = percentage_closer_intensity<float>(depths_, where[i], taps_);
    }

    std::vector<timed_look_up> timed(std::span<const map_receiver> where) const override
    {
        const timed_run run{where.size(), [this, where](std::span<float> result) { intensities(where, result); }};
        return {{1, run, run}};
    }

  private:
    const depth_map& depths_;
    std::span<const float> taps_;
};

class percentage_closer_method final : public shadow_method {
  public:
    percentage_closer_method()
        : shadow_method({.id = "pcf",
                         .family = "pcf",
                         .label = "PCF",
                         .map = depths_kind->id,
                         .format = {"depth_4_samples", "4 samples of 32 bit depth", sizeof(depth_map::pixels[0])}})
    {}

    std::unique_ptr<shadow_map> build(const depth_map& depths, std::span<const float> taps) const override
    {
        return std::make_unique<depths_themselves>(depths, taps);
    }
};

const registered<family> pcf{
    family{.id = "pcf", .label = "percentage-closer filtering", .order = 10, .colour = "#222222"}};
const registered<percentage_closer_method> entry;

} // namespace

} // namespace gnomon::evaluation
