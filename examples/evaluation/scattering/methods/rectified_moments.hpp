// Prefiltered single scattering by moments (Peters et al. 2017, Sec. 5): the shadow map is rectified, averaged along rows, and
// looked up once for each view ray. A method is a file with a storage format and options:
//
//     const registered<rectified_method<moments6_unorm16, rectified_options{...}>> entry{method_facts{...}};
#pragma once

#include "evaluation/scattering/rectified_scene.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/passes/mips.hpp>
#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/rectify.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/scattering/single_scattering.h>
#include <gnomon/simd/rectified_look_up.hpp>
#include <gnomon/storage/formats.hpp>

#include <fmt/format.h>

#include <type_traits>

namespace gnomon::evaluation {

// The weight of visibility between both bounds, beta of Peters et al. 2017, Sec. 5.3.1: by the angle between view ray and light,
// or one for all rays.
enum class overestimation { adaptive, plateau, none, half, full };

template <overestimation how, class Real> Real overestimation_of(const Real& cosine)
{
    if constexpr (how == overestimation::adaptive) return adaptive_overestimation(cosine);
    else if constexpr (how == overestimation::plateau) return plateau_overestimation(cosine);
    else return Real(how == overestimation::none ? 0.0f : how == overestimation::half ? 0.5f : 1.0f);
}

template <class Real> hamburger_bounds<Real> bounds_of(const hankel4<Real>& h, const Real& z_f)
{
    return hamburger4_bounds(h, z_f);
}
template <class Real> hamburger_bounds<Real> bounds_of(const hankel6<Real>& h, const Real& z_f)
{
    return hamburger6_bounds(h, z_f);
}

template <class Format, rectified_options options, overestimation weight>
class rectified_moments final : public scattering_map {
  public:
    explicit rectified_moments(const scattering_scene& scene)
        : rectified_(scene, options), texels_(mip_texels(scene.columns, scene.rows))
    {
        const map_view<texel> map = mips().level(0);
        time("rectify", [&] { rectified_.template rectify<Format>(map); });
        time("prefix", [&] { transmittance_prefix<Format>(map, rectified_.rows, {0, map.height}); });
        time("mips", [&] { build_mips<Format>(mips()); });
    }

    std::size_t bytes() const override
    {
        return texels_.size() * sizeof(texel) + rectified_.rows.size() * sizeof(rectified_row);
    }

    std::vector<build_pass> passes() const override { return passes_; }

    void visibilities(std::span<const view_segment> where, std::span<float> result) const override
    {
        visibilities_by_packs(where.size(), result,
                              [&]<class Real>(std::size_t group) { return intensity(fetch<Real>(where, group)); });
    }

    std::vector<timed_look_up> timed(std::span<const view_segment> where) const override
    {
        return timed_fetches<fetched>(
            where.size(),
            [this, where]<class Real>(std::size_t group) { return this->template fetch<Real>(where, group); },
            []<class Real>(const fetched<Real>& f) { return intensity(f); });
    }

    std::optional<std::vector<float>> exact(std::span<const view_segment> where) const override
    {
        return rectified_.exact(where);
    }

  private:
    using texel = format_texel<Format>;

    template <class Real> struct fetched {
        format_channels<Format, Real> channels;
        Real depth, cosine;
    };

    template <class Real> static Real intensity(const fetched<Real>& f)
    {
        if constexpr (std::is_same_v<Format, convolution_unorm8>)
            return convolution_unorm8_centred_intensity(f.channels, f.depth);
        else
            return bounds_intensity(bounds_of(Format::filtered_factor(f.channels), f.depth),
                                    overestimation_of<weight>(f.cosine));
    }

    // Flattened, so that the compiler inlines look-ups of every format alike and their times compare.
    template <class Real>
    [[gnu::flatten]] fetched<Real> fetch(std::span<const view_segment> where, std::size_t group) const
    {
        const view_rays<Real> to = rays_of<Real>(where, group);
        const rectified_end<Real> ray = rectified_.ray(to);
        return {rectified_channels<Format>(mip_view<const texel>(mips()), rectified_.frame, rectified_.rows,
                                           ray.position, ray.level),
                rectified_depth_at(rectified_.frame, rectified_.rows, ray.position),
                rectified_cosine(to.x, to.y, to.z)};
    }

    mip_view<texel> mips() { return {texels_, rectified_.columns, rectified_.rows.size()}; }
    mip_view<const texel> mips() const { return {texels_, rectified_.columns, rectified_.rows.size()}; }

    void time(const char* name, auto&& pass) { passes_.push_back({name, 1e3 * seconds_on_one_core(pass)}); }

    rectified_scene rectified_;
    std::vector<texel> texels_;
    std::vector<build_pass> passes_;
};

template <class Format, rectified_options options, overestimation weight = overestimation::plateau>
class rectified_method final : public scattering_method {
  public:
    explicit rectified_method(method_facts facts, std::vector<std::string> its_scenes = {})
        : scattering_method(completed(std::move(facts)), id_of(options), std::move(its_scenes))
    {}

    std::unique_ptr<scattering_map> build(const scattering_scene& scene) const override
    {
        return std::make_unique<rectified_moments<Format, options, weight>>(scene);
    }

  private:
    static method_facts completed(method_facts facts)
    {
        facts.map = rectified_kind->id;
        facts.format = {std::string(Format::id), std::string(Format::name), double(Format::bytes_per_texel)};
        return facts;
    }
};

} // namespace gnomon::evaluation
