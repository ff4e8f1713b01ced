// Accumulation for a stochastic camera: a few shadow maps of one time each. A sample looks up the map of its part of the
// shutter interval, where the point of its surface is at the time of that map.
#include "evaluation/core/timing.hpp"
#include "evaluation/layered/layered_method.hpp"
#include "evaluation/motion/accumulation.hpp"

#include <gnomon/filters/percentage_closer.h>
#include <gnomon/motion/layers/stochastic_sample.h>

namespace gnomon::evaluation {

namespace {

class slices final : public layered_map {
  public:
    slices(const layered_input& from, int count)
    {
        resolution = from.resolution;
        sampling_ms = 1e3 * seconds_on_one_core([&] {
                          maps_ = accumulate(from.stage.world, from.stage.light, resolution, middle_times(count));
                      });
    }

    std::size_t bytes() const override
    {
        return maps_.depths.size() * std::size_t(resolution) * std::size_t(resolution) * sizeof(float);
    }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const auto count = float(maps_.times.size()), size = float(resolution);
        for (std::size_t i = 0; i < where.size(); ++i) {
            const auto slice = std::size_t(slice_of(where[i].t, count));
            const float t = maps_.times[slice];
            const receiver_path<float> path = biased_surface(where[i]).path;
            auto state = percentage_closer_begin(range_depth(path.depth, t));
            for_each_tap(receiver_path_at(path, t), [&](float column, float row, float weight) {
                if (column >= 0 && row >= 0 && column < size && row < size)
                    state = percentage_closer_add(state, maps_.depths[slice](int(column), int(row))[0], weight);
            });
            result[i] = 1 - percentage_closer_end(state);
        }
    }

    shutter_exposure<float> averaged(const stochastic_receiver& r) const override
    {
        const float t = maps_.times[std::size_t(slice_of(r.t, float(maps_.times.size())))];
        return {t, t};
    }

  private:
    accumulated_maps maps_;
};

class accumulated_slices final : public layered_method {
  public:
    accumulated_slices()
        : layered_method({.id = "accumulated_slices",
                          .family = "accumulation",
                          .label = "accumulation",
                          .order = 10,
                          .map = "depths_at_times",
                          .format = {"f32_depth", "32 bit depth"}},
                         {{.parameters = {{"times", 4}}, .label = "of 4", .comparisons = {equal_input}},
                          {.parameters = {{"times", 16}}, .label = "of 16", .comparisons = {equal_time, equal_memory}}},
                         false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        return std::make_unique<slices>(from, int(how.at("times")));
    }
};

const registered<accumulated_slices> entry;

} // namespace

} // namespace gnomon::evaluation
