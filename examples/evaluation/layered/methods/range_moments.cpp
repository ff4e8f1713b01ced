// Moments over time of resolved ranges, in closed form: a moment shadow map of motion without noise, for static
// receivers.
#include "evaluation/core/timing.hpp"
#include "evaluation/layered/layered_method.hpp"

#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/range/moments.hpp>
#include <gnomon/storage/moments4.hpp>

namespace gnomon::evaluation {

namespace {

class moments_of_ranges final : public layered_map {
    using format = moments4_unorm16;

  public:
    explicit moments_of_ranges(const range_shadow_map& ranges)
        : texels_(std::size_t(ranges.resolution) * std::size_t(ranges.resolution))
    {
        resolution = ranges.resolution;
        sampling_ms = ranges.build_ms;
        conversion_ms = 1e3 * seconds_on_one_core([&] {
                            fill_range_moments<format>(ranges.map(), map_view<format::texel>(texels_, size(), size()));
                        });
    }

    std::size_t bytes() const override { return texels_.size() * sizeof(format::texel); }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const map_view<const format::texel> map(texels_, size(), size());
        for (std::size_t i = 0; i < where.size(); ++i) {
            const stochastic_receiver& r = where[i];
            const float z_f = r.depth - float(motion_bias_radius) * r.slope;
            result[i] = 1 - format::intensity(bilinear<format>(map, r.x, r.y, border_mode::lit), z_f);
        }
    }

  private:
    std::size_t size() const { return std::size_t(resolution); }

    std::vector<format::texel> texels_;
};

const registered<family> time_moments{
    family{.id = "range_moments", .label = "time moments of ranges", .order = 225, .colour = "#8c564b"}};

const registered<map_kind> time_moments_kind{
    map_kind{.id = "time_moments", .label = "moments over time", .order = 145}};

class range_moments_map final : public layered_method {
  public:
    range_moments_map()
        : layered_method({.id = "range_moments",
                          .family = time_moments->id,
                          .label = "time moments of ranges",
                          .order = 42,
                          .map = time_moments_kind->id,
                          .format = {std::string(moments4_unorm16::id), std::string(moments4_unorm16::name)}},
                         {{.comparisons = {equal_input, equal_time, equal_memory}}}, false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters&) const override
    {
        return std::make_unique<moments_of_ranges>(*from.ranges().map("resolved_ranges"));
    }
};

const registered<range_moments_map> entry;

} // namespace

} // namespace gnomon::evaluation
