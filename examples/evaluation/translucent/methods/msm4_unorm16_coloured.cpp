// Coloured shadows by one moment shadow map of 64 bits for each of red, green and blue light (Peters et al. 2017, Sec. 3.3).
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

using coloured_rule = moments_rule<moments4_unorm16>;
using one_colour = blended_map<coloured_rule>;

template <class Real> struct channels_of_colours {
    channels4<Real> red, green, blue;
};

class coloured_map final : public translucent_map {
  public:
    coloured_map(const translucent_occluders& occluders, std::span<const float> taps, float least_alpha)
        : maps_{one_colour(occluders, taps, {colour::red, least_alpha}),
                one_colour(occluders, taps, {colour::green, least_alpha}),
                one_colour(occluders, taps, {colour::blue, least_alpha})}
    {}

    std::size_t bytes() const override { return maps_.size() * maps_[0].bytes(); }

    void intensities(std::span<const map_receiver> where, colour of, bound which,
                     std::span<float> result) const override
    {
        maps_[static_cast<std::size_t>(of) - static_cast<std::size_t>(colour::red)].intensities(where, of, which,
                                                                                                result);
    }

    // All colours; the mean is kept.
    std::vector<timed_look_up> timed(std::span<const map_receiver> where) const override
    {
        const auto fetch = [this](const map_receiver& r) {
            return channels_of_colours<float>{maps_[0].fetch(r), maps_[1].fetch(r), maps_[2].fetch(r)};
        };
        const auto mean = [this]<class Real>(const channels_of_colours<Real>& c, Real z_f) {
            const auto of = [&](const channels4<Real>& one, const one_colour& map) {
                return coloured_rule::lower(one, Real(map.roundings()), z_f);
            };
            return literal<Real>(1. / 3) * (of(c.red, maps_[0]) + of(c.green, maps_[1]) + of(c.blue, maps_[2]));
        };
        return timed_look_ups<channels_of_colours>(where, fetch, mean);
    }

  private:
    std::array<one_colour, 3> maps_;
};

class coloured_method final : public translucent_method {
  public:
    coloured_method()
        : translucent_method(
              {.id = "msm4_unorm16_coloured",
               .family = "msm4",
               .label = "MSM 3 x 64 bit, coloured",
               .order = 150,
               .map = translucent_map_kind->id,
               .format = {"moments4_unorm16_x3", "3 x 4x16 UNORM", 3 * moments4_unorm16::bytes_per_texel}},
              {.coloured = true})
    {}

    std::unique_ptr<translucent_map> build(const translucent_occluders& occluders, std::span<const float> taps,
                                           const build_settings& how) const override
    {
        return std::make_unique<coloured_map>(occluders, taps, how.least_alpha);
    }
};

const registered<coloured_method> entry;

} // namespace

} // namespace gnomon::evaluation
