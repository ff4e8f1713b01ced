// Percentage-closer soft shadows (Fernando 2005) with the settings of Peters et al. 2017, Sec. 4.6: the search loads every
// texel of its region, the filter is 2 x 2 percentage-closer filtering, and the search may end the look-up. Three sizes of
// the search region, beyond which shadows are too hard.
#include "evaluation/soft/percentage_closer_soft.hpp"

#include <fmt/format.h>

namespace gnomon::evaluation {

namespace {

class depths_at_centres final : public soft_shadow_map {
  public:
    depths_at_centres(const soft_depths& depths, const soft_light& light) : depths_(depths.centres), light_(light) {}

    std::size_t bytes() const override { return depths_.pixels.size() * sizeof(depths_.pixels[0]); }

    void intensities(std::span<const soft_receiver> where, std::span<float> result) const override
    {
        run<float>(where, result);
    }

    // The kernel is the look-up.
    std::vector<timed_look_up> timed(std::span<const soft_receiver> where) const override
    {
        return {timed_in<float>(where), timed_in<receiver_pack>(where)};
    }

  private:
    template <class Real> void run(std::span<const soft_receiver> where, std::span<float> result) const
    {
        run_groups<Real>(where.size() / lanes_of<Real>, result, [&](std::size_t i) {
            return percentage_closer_soft_intensity<Real>(depths_, light_, place_of<Real>(where, i), true);
        });
    }

    template <class Real> timed_look_up timed_in(std::span<const soft_receiver> where) const
    {
        const timed_run all{where.size() / lanes_of<Real> * lanes_of<Real>,
                            [this, where](std::span<float> result) { run<Real>(where, result); }};
        return {int(lanes_of<Real>), all, all};
    }

    const renderer::image<std::array<float, 1>>& depths_;
    soft_light light_;
};

class percentage_closer_soft_method final : public soft_method {
  public:
    explicit percentage_closer_soft_method(int search)
        : soft_method({.id = fmt::format("pcss_{}", search),
                       .family = "pcss",
                       .label = fmt::format("PCSS {0} x {0}", search),
                       .order = double(search),
                       .map = "depths",
                       .format = {"depth_float", "32 bit depth", sizeof(float)}},
                      float(search))
    {}

    std::unique_ptr<soft_shadow_map> build(const soft_depths& depths, const soft_light& light) const override
    {
        return std::make_unique<depths_at_centres>(depths, light);
    }
};

const registered<family> pcss{
    family{.id = "pcss", .label = "percentage-closer soft shadows", .order = 15, .colour = "#444444"}};
const registered<percentage_closer_soft_method> small{9}, medium{15}, large{27};

} // namespace

} // namespace gnomon::evaluation
