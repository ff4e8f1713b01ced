#include "fog.hpp"

#include <gnomon/storage/formats.hpp>

#include <algorithm>
#include <cstddef>

namespace gnomon::evaluation {

namespace {

constexpr double leak_allowed = 0.1, darkening_allowed = 0.02;
constexpr double farthest_pane = 0.2;
constexpr float back_depth = 0.8f;

// The most that a receiver before, in and behind the fog is too dark.
double darkening(std::span<const pane> panes, float back, const intensity_at_depth& intensity)
{
    const std::size_t step = std::max<std::size_t>(panes.size() / 16, 1);
    double worst = 0, transmittance = 1;
    const auto see = [&](float z_f) { worst = std::max(worst, double(intensity(z_f)) - (1 - transmittance)); };
    see(-1);
    for (std::size_t i = panes.size(); i-- > 0;) {
        if (i % step == 0) see(panes[i].depth);
        transmittance *= 1 - double(panes[i].opacity);
        const float next = i > 0 ? panes[i - 1].depth : back;
        if (i % step == 0) see(0.5f * (panes[i].depth + next));
    }
    see(back);
    return worst;
}

fog_map as_filtered(const filterable_method& m)
{
    return {m.id, m.label, [&m](std::span<const pane> panes, float back, float) -> intensity_at_depth {
                return [&m, c = blended(m, panes, back)](float z_f) { return m.intensity(c, z_f); };
            }};
}

template <storage_format Format> fog_map as_blended(const char* label)
{
    return {std::string(Format::id) + "_blended", label,
            [](std::span<const pane> panes, float back, float roundings) -> intensity_at_depth {
                return [c = blended<Format>(panes, back), roundings](float z_f) {
                    return Format::blended_intensity(c, roundings, z_f);
                };
            }};
}

template <absorbance_format Format> fog_map as_absorbance(const char* label)
{
    return {std::string(Format::id), label, [](std::span<const pane> panes, float back, float) -> intensity_at_depth {
                return [=, c = accumulated<Format>(panes), additions = float(panes.size())](float z_f) {
                    return back < z_f ? 1 : 1 - Format::transmittance(c, additions, 1, z_f);
                };
            }};
}

} // namespace

double exact_intensity(std::span<const pane> panes, float back, float z_f)
{
    double transmittance = back < z_f ? 0 : 1;
    for (const pane& p : panes)
        if (p.depth < z_f) transmittance *= 1 - double(p.opacity);
    return 1 - transmittance;
}

filterable_method::channels blended(const filterable_method& m, std::span<const pane> panes, float back)
{
    filterable_method::channels below = m.from_depth(back);
    for (const pane& p : panes) {
        const filterable_method::channels above = m.from_depth(p.depth);
        for (std::size_t k = 0; k < below.size(); ++k) below[k] = over(below[k], above[k], p.opacity);
        below = m.store(below);
    }
    return below;
}

std::vector<translucent_fragment> fragments_of(std::span<const pane> panes)
{
    std::vector<translucent_fragment> result;
    for (const pane& p : panes) result.push_back({0, 0, p.depth, p.opacity});
    return result;
}

std::vector<fog_map> fog_maps()
{
    std::vector<fog_map> result;
    for (const method* m : methods_in_order())
        if (const auto* filterable = dynamic_cast<const filterable_method*>(m))
            result.push_back(as_filtered(*filterable));
    result.push_back(as_blended<moments4_unorm16>("MSM 64 bit, for blends"));
    result.push_back(as_blended<moments4_half>("MSM 64 bit half, for blends"));
    result.push_back(as_blended<moments4_float>("MSM 128 bit, for blends"));
    result.push_back(as_blended<moments6_unorm10>("MSM6 60 bit, for blends"));
    result.push_back(as_blended<moments6_unorm16>("MSM6 96 bit, for blends"));
    result.push_back(as_blended<moments6_float>("MSM6 192 bit, for blends"));
    result.push_back(as_absorbance<absorbance4_half>("absorbance, 80 bit"));
    result.push_back(as_absorbance<absorbance4_float>("absorbance, 160 bit"));
    return result;
}

fog_errors errors_in_fog(const fog_map& m, std::span<const float> opacities, float least_opacity)
{
    fog_errors worst{};
    for (const double thickness : {0.002, 0.003, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8}) {
        const double step = thickness / double(opacities.size());
        std::vector<pane> panes, drawn;
        for (const float opacity : opacities) {
            panes.push_back({float(farthest_pane - double(panes.size()) * step), opacity});
            if (opacity >= least_opacity) drawn.push_back(panes.back());
        }
        const float roundings = blend_roundings_of_layers(least_opacity, float(drawn.size()));
        const intensity_at_depth intensity = m.kept(drawn, back_depth, roundings);
        const double exact = exact_intensity(panes, back_depth, back_depth);
        worst.leak = std::max(worst.leak, exact - double(intensity(back_depth)));
        worst.darkening = std::max(worst.darkening, darkening(panes, back_depth, intensity));
    }
    return worst;
}

double fog_error(const fog_map& m, std::span<const float> opacities, float least_opacity)
{
    const fog_errors e = errors_in_fog(m, opacities, least_opacity);
    return std::max(e.leak / leak_allowed, e.darkening / darkening_allowed);
}

std::vector<sweep_layer> layers_of_fog_maps(const std::function<double(const fog_map&, double x, double y)>& error)
{
    std::vector<sweep_layer> result;
    for (const fog_map& m : fog_maps())
        result.push_back({m.id, m.label, [error, m](double x, double y) { return error(m, x, y); }});
    return result;
}

} // namespace gnomon::evaluation
