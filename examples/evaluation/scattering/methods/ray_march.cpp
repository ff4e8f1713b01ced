// Ray marching through the shadow map, jittered by pixel, with 16 to 1024 steps; of depths as they are, and of depths with 16
// bits, as Peters et al. 2017, Sec. 5.5.1, compare with.
#include "shadow_map_steps.hpp"

#include <gnomon/comparators/ray_march.h>
#include <gnomon/scattering/single_scattering.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace gnomon::evaluation {

namespace {

const registered<map_kind> depths_kind{map_kind{.id = "light_depths", .label = "depths of the light", .order = 62}};
const registered<family> ray_marching{
    family{.id = "ray_march", .label = "ray marching", .order = 16, .colour = "#ff7f0e"}};

template <class Texel> class marched_map final : public scattering_map {
  public:
    marched_map(const scattering_scene& scene, int steps)
        : depths_(scene), steps_(steps), share_(1 / float(steps)), extinction_(scene.extinction)
    {}

    std::size_t bytes() const override { return depths_.bytes(); }

    void visibilities(std::span<const view_segment> where, std::span<float> result) const override
    {
        visibilities_by_packs(where.size(), result,
                              [&]<class Real>(std::size_t group) { return intensity<Real>(where, group); });
    }

    std::vector<timed_look_up> timed(std::span<const view_segment> where) const override
    {
        return timed_whole(where.size(), [this, where]<class Real>(std::size_t group) {
            return this->template intensity<Real>(where, group);
        });
    }

  private:
    // Of rays that are inside the map and before its far plane throughout, or not.
    template <bool is_inside, class Real>
    Real shadowed(map_vector<Real> at, const map_vector<Real>& step, const Real& transmittance) const
    {
        ray_march<Real> state = ray_march_begin(transmittance);
        for (int k = 0; k < steps_; ++k) {
            const map_vector<Real> place = is_inside ? at : depths_.clamped(at);
            state = ray_march_add(state, depths_.at(place.x, place.y), place.z);
            at = {at.x + step.x, at.y + step.y, at.z + step.z};
        }
        return ray_march_end(state);
    }

    template <class Real> [[gnu::flatten]] Real intensity(std::span<const view_segment> where, std::size_t group) const
    {
        const view_rays<Real> to = rays_of<Real>(where, group);
        const Real jitter = ray_march_jitter(to.column - Real(0.5f), to.row - Real(0.5f)), share(share_);
        const Real transmittance =
            transmittance_over(Real(extinction_) * share * gnomon_sqrt(to.x * to.x + to.y * to.y + to.z * to.z));
        const map_vector<Real> eye = depths_.template eye<Real>(),
                               step = depths_.vector(to.x * share, to.y * share, to.z * share);
        const auto point = [&](const Real& k) {
            return map_vector<Real>{eye.x + k * step.x, eye.y + k * step.y, eye.z + k * step.z};
        };
        const bool is_inside = depths_.holds(eye) && depths_.holds(point(Real(float(steps_) + 0.5f)));
        const map_vector<Real> first = point(jitter);
        return is_inside ? shadowed<true>(first, step, transmittance) : shadowed<false>(first, step, transmittance);
    }

    framed_depths<Texel> depths_;
    int steps_;
    float share_, extinction_;
};

template <class Texel> class ray_march_method final : public scattering_method {
  public:
    explicit ray_march_method(int its_steps)
        : scattering_method({.id = fmt::format("ray_march_{}{}", its_steps, is_float ? "" : "_unorm16"),
                             .family = "ray_march",
                             .label = fmt::format("ray marching, {} steps{}", its_steps, is_float ? "" : ", 16 bit"),
                             .order = double(its_steps) + (is_float ? 0 : 0.5),
                             .map = "light_depths",
                             .format = is_float ? storage_facts{"depth_float", "32 bit depth", sizeof(Texel)}
                                                : storage_facts{"depth_unorm16", "16 bit depth", sizeof(Texel)},
                             .parameters = {{"steps", double(its_steps)}}}),
          steps(its_steps)
    {}

    std::unique_ptr<scattering_map> build(const scattering_scene& scene) const override
    {
        return std::make_unique<marched_map<Texel>>(scene, steps);
    }

    const int steps;

  private:
    static constexpr bool is_float = std::is_same_v<Texel, float>;
};

const registered<ray_march_method<float>> few{16}, some{32}, many{128}, most{1024};
const registered<ray_march_method<std::uint16_t>> some_of_16{32}, many_of_16{128};

} // namespace

} // namespace gnomon::evaluation
