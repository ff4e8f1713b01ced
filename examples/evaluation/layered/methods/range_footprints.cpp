// Ranges over the footprint in time of each sample of the camera, which follows the surface: the mean over the stratum
// that the sample stands for, in closed form. The strata of a pixel fill the shutter interval, so the noise of the
// camera's times is gone as well.
#include "evaluation/layered/layered_method.hpp"
#include "evaluation/motion/receivers/while_facing.hpp"

#include <gnomon/passes/range/footprint.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::evaluation {

namespace {

// The receiver between two times of its surface, which lasts from 0 to 1.
light_receiver part_of(const light_receiver& whole, const shutter_exposure<float>& during)
{
    const float length = during.end - during.begin;
    const auto share = [&](float t) { return (t - during.begin) / length; };
    return {receiver_path_clip(whole.path, during.begin, during.end),
            {std::clamp(share(whole.facing.begin), 0.f, 1.f), std::clamp(share(whole.facing.end), 0.f, 1.f),
             share(whole.facing.gap_begin), share(whole.facing.gap_end)}};
}

class ranges_over_footprints final : public layered_map {
  public:
    ranges_over_footprints(std::shared_ptr<const range_shadow_map> ranges, bool around)
        : ranges_(std::move(ranges)), around_(around)
    {
        resolution = ranges_->resolution;
        sampling_ms = ranges_->build_ms;
    }

    std::size_t bytes() const override { return ranges_->bytes; }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const range_map<float> map = ranges_->map();
        for (std::size_t i = 0; i < where.size(); ++i) {
            const light_receiver part = part_of(biased_surface(where[i]), averaged(where[i]));
            result[i] = while_facing(part, [&](const receiver_path<float>& path) {
                return 1 - footprint_intensity(map, path, {path.depth.t0, path.depth.t1});
            });
        }
    }

    shutter_exposure<float> averaged(const stochastic_receiver& r) const override
    {
        const float count = std::round(0.5f / std::max(r.t - r.t0, r.t1 - r.t));
        return around_ ? shutter_exposure<float>{r.t0, r.t1} : footprint_stratum(r.t, count);
    }

  private:
    std::shared_ptr<const range_shadow_map> ranges_;
    bool around_;
};

class range_footprints final : public layered_method {
  public:
    range_footprints()
        : layered_method(
              {.id = "range_footprints",
               .family = "footprints",
               .label = "ranges over footprints",
               .order = 50,
               .map = resolved_lists_kind->id,
               .format = {"ranges_20b", "20 B ranges"}},
              {{.comparisons = {equal_input, equal_time, equal_memory}},
               {.parameters = {{"around", 1}}, .label = "around the sample's time", .comparisons = {of_settings}}},
              false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        return std::make_unique<ranges_over_footprints>(from.ranges().map("caster_ranges", {{"totals", 1}}),
                                                        value_of(how, "around", 0) != 0);
    }
};

const registered<range_footprints> entry;

} // namespace

} // namespace gnomon::evaluation
