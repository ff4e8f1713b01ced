#include "measurement.hpp"

#include <algorithm>
#include <memory>

namespace gnomon::evaluation {

measurement measure(const shadow_method& m, const shaded_stage& stage)
{
    measurement result;
    std::unique_ptr<shadow_map> map;
    result.build_ms = 1e3 * seconds([&] { map = m.build(stage.depths, stage.taps); });
    result.map_bytes = double(map->bytes());
    std::vector<float> intensities(stage.where.size());
    for (const timed_look_up& t : map->timed(stage.where.biased))
        result.times.push_back({t.lanes, nanoseconds(t.kernel, intensities), nanoseconds(t.look_up, intensities)});
    const auto visibility = [&](std::span<const map_receiver> where) {
        map->intensities(where, intensities);
        std::vector<float> visible(intensities.size());
        std::ranges::transform(intensities, visible.begin(), [](float intensity) { return 1 - intensity; });
        return visible;
    };
    result.visibility = visibility(stage.where.biased);
    result.unbiased = visibility(stage.where.unbiased);
    return result;
}

} // namespace gnomon::evaluation
