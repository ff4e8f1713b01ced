// The steps of a soft look-up in a summed-area table, for floats and for packs of receivers: search, penumbra, filter
// (Peters et al. 2017, Sec. 4.3 to 4.5). A method is a file with kernels and options:
//
//     struct kernels {
//         using table = moments4_summed;
//         static auto region(channels, most_texels);            what a search makes of its mean channels
//         static Real blocker(region, z_f);                     the mean blocker depth
//         static Real occlusion(region, z_f);                   the shadow intensity of the search region
//         static Real shadow(channels, most_texels, z_f);       of the filter region
//     };
//     const registered<summed_method<kernels, look_up_options{}>> entry{method_facts{...}};
#pragma once

#include "lanes.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/passes/summed_area.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace gnomon::evaluation {

inline const registered<map_kind> summed_kind{map_kind{.id = "summed_area", .label = "summed-area table", .order = 30}};

struct look_up_options {
    bool interpolated = true; // else the filter rectangle snaps to the grid of texels
    bool dithers = false;     // snaps at random, so that the mean over neighbours is that of interpolation
    bool skips_umbra = true, skips_lit = false;
};

// Of the shadow intensity of a search region, at which its receivers are taken for umbra; intensities are divided by 1 -
// umbra_epsilon, so that no step is seen.
inline constexpr float umbra_epsilon = 0.01f;

// A number in [0, 1) that looks random, from the place.
inline float dither_of(const soft_receiver& where)
{
    std::uint32_t h = std::bit_cast<std::uint32_t>(where.x) * 0x9e3779b1u ^ std::bit_cast<std::uint32_t>(where.y);
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return float((h ^ (h >> 16)) >> 8) * 0x1p-24f;
}

// The rectangle with its edges moved to lines of the grid, below by less than 1 - offset and above by at most offset.
inline summed_area_rectangle<float> snapped(const summed_area_rectangle<float>& r, float offset)
{
    return {std::floor(r.x0 + offset), std::floor(r.y0 + offset), std::floor(r.x1 + offset), std::floor(r.y1 + offset)};
}

template <class Kernels, look_up_options how> class summed_map final : public soft_shadow_map {
  public:
    using table = typename Kernels::table;
    template <class Real> using channels = format_channels<table, Real>;

    summed_map(const soft_depths& depths, const soft_light& light)
        : light_(light),
          most_texels_(static_cast<std::size_t>(light.most_texels())),
          width_(static_cast<std::size_t>(depths.samples.width)),
          height_(static_cast<std::size_t>(depths.samples.height)),
          texels_(width_ * height_)
    {
        using samples = std::array<float, 4>;
        const map_view<const samples> source{depths.samples.pixels, width_, height_};
        build_summed_area<table>(source, map_view<texel>{texels_, width_, height_}, most_texels_);
    }

    std::size_t bytes() const override { return texels_.size() * sizeof(texel); }

    void intensities(std::span<const soft_receiver> where, std::span<float> result) const override
    {
        run_all<float>(where, result);
    }

    std::vector<timed_look_up> timed(std::span<const soft_receiver> where) const override
    {
        return {timed_in<float>(where), timed_in<receiver_pack>(where)};
    }

    std::optional<skipped_shares> skipped(std::span<const soft_receiver> where) const override
    {
        if (!how.skips_umbra && !how.skips_lit) return {};
        std::size_t umbra = 0, lit = 0;
        for (const soft_receiver& r : where) {
            const float whole = Kernels::occlusion(Kernels::region(search(r), light_.most_texels()), r.depth);
            umbra += how.skips_umbra && whole > 1 - umbra_epsilon;
            lit += how.skips_lit && whole < umbra_epsilon;
        }
        const double all = double(std::max<std::size_t>(where.size(), 1));
        return skipped_shares{double(umbra) / all, double(lit) / all};
    }

  private:
    using texel = format_texel<table>;

    map_view<const texel> map() const { return {texels_, width_, height_}; }

    // Means over the search region, and over the filter region unless the lane is done. Lanes are fetched one by one.
    template <class Real> channels<Real> search(const soft_place<Real>& where) const
    {
        const auto r = summed_area_grow(light_.clipped(light_.search_rectangle(where)));
        return mean_on_grid(r);
    }
    template <class Real>
    channels<Real> filter(const soft_place<Real>& where, const soft_widths<Real>& widths, const Real& done) const
    {
        const auto rectangle = soft_light::filter_rectangle(where, widths);
        if constexpr (how.dithers || !how.interpolated) {
            const scattered<summed_area_rectangle, Real> smooth(rectangle);
            const scattered<soft_place, Real> places(where);
            return mean_on_grid(summed_area_grow(light_.clipped(gathered<summed_area_rectangle, Real>(
                [&](std::size_t i) { return snapped(smooth[i], how.dithers ? dither_of(places[i]) : 0.5f); }))));
        } else {
            const auto r = light_.clipped(rectangle);
            const auto a = summed_area_split(r.x0, r.x1), b = summed_area_split(r.y0, r.y1);
            const scattered<summed_area_parts, Real> columns(a), rows(b);
            const scattered<std::type_identity_t, Real> is_done(done);
            return gathered<channels, Real>([&](std::size_t i) {
                return is_done[i] > 0 ? channels<float>{} : rectangle_mean<table>(map(), scale_, columns[i], rows[i]);
            });
        }
    }
    template <class Real> channels<Real> mean_on_grid(const summed_area_rectangle<Real>& r) const
    {
        const scattered<summed_area_rectangle, Real> lines(r);
        return gathered<channels, Real>([&](std::size_t i) { return grid_mean<table>(map(), scale_, lines[i]); });
    }

    // Shadow intensity from the channels that search(where) and filter(where, widths, done) return.
    template <class Real> Real shadow(const soft_place<Real>& where, const auto& search, const auto& filter) const
    {
        const Real most = Real(light_.most_texels()), none = Real(0), all = Real(1);
        const auto around = Kernels::region(search(where), most);
        const Real whole = Kernels::occlusion(around, where.depth);
        const auto in_umbra = Real(how.skips_umbra ? 1 - umbra_epsilon : 2) < whole;
        const auto in_light = whole < Real(how.skips_lit ? umbra_epsilon : -1);
        const auto done = in_umbra || in_light;
        Real result = gnomon_select(in_umbra, all, none);
        if (gnomon_any(!done)) {
            const soft_widths<Real> widths = light_.penumbra(where.depth, Kernels::blocker(around, where.depth));
            const Real found = Kernels::shadow(filter(where, widths, gnomon_select(done, all, none)), most,
                                               biased_depth(where, widths));
            result = gnomon_select(done, result, over_darken(found, 1 - umbra_epsilon));
        }
        return result;
    }

    // Flattened, so that the compiler inlines look-ups of every method alike and their times compare.
    template <class Real> [[gnu::flatten]] Real look_up(const soft_place<Real>& where) const
    {
        return shadow(
            where, [this](const soft_place<Real>& at) { return search(at); },
            [this](const soft_place<Real>& at, const soft_widths<Real>& widths, const Real& done) {
                return filter(at, widths, done);
            });
    }

    template <class Real> void run_all(std::span<const soft_receiver> where, std::span<float> result) const
    {
        run_groups<Real>(where.size() / lanes_of<Real>, result,
                         [&](std::size_t i) { return look_up(place_of<Real>(where, i)); });
    }

    template <class Real> struct fetched {
        soft_place<Real> where;
        channels<Real> around, within;
    };

    template <class Real> timed_look_up timed_in(std::span<const soft_receiver> where) const
    {
        const std::size_t groups = where.size() / lanes_of<Real>, covered = groups * lanes_of<Real>;
        std::vector<fetched<Real>> values(groups);
        tbb::parallel_for(std::size_t(0), groups, [&](std::size_t i) {
            fetched<Real>& f = values[i];
            f.where = place_of<Real>(where, i);
            f.around = search(f.where);
            const Real blocker = Kernels::blocker(Kernels::region(f.around, Real(light_.most_texels())), f.where.depth);
            f.within = filter(f.where, light_.penumbra(f.where.depth, blocker), Real(0));
        });
        const auto kernels = [this, groups, values = std::move(values)](std::span<float> result) {
            run_groups<Real>(groups, result, [&](std::size_t i) {
                const fetched<Real>& f = values[i];
                return shadow(
                    f.where, [&](const auto&) -> const auto& { return f.around; },
                    [&](const auto&...) -> const auto& { return f.within; });
            });
        };
        return {int(lanes_of<Real>), {covered, kernels}, {covered, [this, where](std::span<float> result) {
                                                              run_all<Real>(where, result);
                                                          }}};
    }

    soft_light light_;
    std::size_t most_texels_, width_, height_;
    double scale_ = double(summed_area_scale(float(most_texels_)));
    std::vector<texel> texels_;
};

template <class Kernels, look_up_options how> class summed_method final : public soft_method {
  public:
    explicit summed_method(method_facts facts) : soft_method(completed(std::move(facts))) {}

    std::unique_ptr<soft_shadow_map> build(const soft_depths& depths, const soft_light& light) const override
    {
        return std::make_unique<summed_map<Kernels, how>>(depths, light);
    }

  private:
    static method_facts completed(method_facts facts)
    {
        using table = typename Kernels::table;
        facts.map = summed_kind->id;
        facts.format = {std::string(table::id), std::string(table::name), double(table::bytes_per_texel)};
        return facts;
    }
};

} // namespace gnomon::evaluation
