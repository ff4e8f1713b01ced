#include "measurement.hpp"

#include <gnomon/moments/bounds.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace gnomon::evaluation {

namespace {

constexpr std::array grey_alone{colour::grey};

numbers intensities(const translucent_map& map, std::span<const map_receiver> where, colour of, bound which)
{
    numbers result(where.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, where.size(), 4096), [&](const auto& range) {
        map.intensities(where.subspan(range.begin(), range.size()), of, which,
                        std::span(result).subspan(range.begin(), range.size()));
    });
    return result;
}

} // namespace

parameters showing::parameters() const
{
    evaluation::parameters result;
    if (in_smoke == bound::middle) result["overestimation"] = 0.5;
    if (strength < 1) result["strength"] = 0.95;
    return result;
}

std::span<const colour> colours_of(const translucent_method& m)
{
    if (m.is.coloured) return primary_colours;
    return grey_alone;
}

numbers shadows::visibility(const translucent_view& view, std::size_t of, const showing& how) const
{
    numbers result(lower[of].size());
    const numbers& in_smoke = middle[of];
    const bool takes_middle = how.in_smoke == bound::middle && !in_smoke.empty();
    for (std::size_t i = 0; i < result.size(); ++i) {
        const bool is_middle = takes_middle && i >= view.first_in_smoke;
        const float intensity = is_middle ? in_smoke[i - view.first_in_smoke] : lower[of][i];
        result[i] = 1 - over_darken(intensity, how.strength);
    }
    return result;
}

shadows shadows_of(const translucent_method& m, const translucent_map& map, const translucent_view& view)
{
    shadows result;
    for (const colour of : colours_of(m)) {
        result.lower.push_back(intensities(map, view.where, of, bound::lower));
        result.middle.push_back(m.is.between_bounds ? intensities(map, view.smoke(), of, bound::middle) : numbers());
    }
    return result;
}

measured_map build(const translucent_method& m, const translucent_occluders& occluders, std::span<const float> taps,
                   const build_settings& how)
{
    measured_map result;
    result.build_ms = 1e3 * seconds_on_one_core([&] { result.map = m.build(occluders, taps, how); });
    return result;
}

std::vector<measured_time> times_of(const translucent_map& map, const translucent_view& view)
{
    constexpr std::size_t most = 1 << 15;
    std::vector<map_receiver> where;
    for (const auto& group : {view.surfaces(), view.smoke()}) {
        const std::size_t count = std::min(most, group.size());
        const auto chosen = group.subspan((group.size() - count) / 2, count);
        where.insert(where.end(), chosen.begin(), chosen.end());
    }
    numbers found(where.size());
    std::vector<measured_time> result;
    const double enough = 0.04;
    for (const timed_look_up& t : map.timed(where))
        result.push_back({t.lanes, nanoseconds(t.kernel, found, enough), nanoseconds(t.look_up, found, enough)});
    return result;
}

} // namespace gnomon::evaluation
