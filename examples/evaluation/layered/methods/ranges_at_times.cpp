// Exact ranges, each receiver at its sample's time: what is left of its noise is the camera's.
#include "evaluation/layered/layered_method.hpp"
#include "evaluation/motion/receivers/stochastic.hpp"

namespace gnomon::evaluation {

namespace {

class ranges_map final : public layered_map {
  public:
    explicit ranges_map(std::shared_ptr<const range_shadow_map> ranges) : ranges_(std::move(ranges))
    {
        resolution = ranges_->resolution;
        sampling_ms = ranges_->build_ms;
    }

    std::size_t bytes() const override { return ranges_->bytes; }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const range_map<float> map = ranges_->map();
        for (std::size_t i = 0; i < where.size(); ++i)
            result[i] = visibility_at(map, biased_surface(where[i]), where[i].t);
    }

    shutter_exposure<float> averaged(const stochastic_receiver& r) const override { return {r.t, r.t}; }

  private:
    std::shared_ptr<const range_shadow_map> ranges_;
};

class ranges_at_times final : public layered_method {
  public:
    ranges_at_times()
        : layered_method({.id = "ranges_at_times",
                          .family = "resolved_ranges",
                          .label = "ranges at the camera's times",
                          .order = 20,
                          .map = resolved_lists_kind->id,
                          .format = {"ranges_20b", "20 B ranges"}},
                         {{.comparisons = {equal_input}}}, false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters&) const override
    {
        return std::make_unique<ranges_map>(from.ranges().map("resolved_ranges"));
    }
};

const registered<ranges_at_times> entry;

} // namespace

} // namespace gnomon::evaluation
