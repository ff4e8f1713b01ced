#include "stochastic.hpp"

#include "evaluation/motion/motion_view.hpp"
#include "range_receiver.hpp"

#include <gnomon/motion/range/range_cover.h>
#include <gnomon/passes/range/look_up.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::evaluation {

namespace {

bool faces_at(const light_receiver& r, float t)
{
    const float passed = range_elapsed(r.path.depth, t);
    return r.facing.begin <= passed && passed <= r.facing.end &&
           !(r.facing.gap_begin < passed && passed < r.facing.gap_end);
}

class stochastic_receiver final : public range_receiver {
  public:
    stochastic_receiver()
        : range_receiver({.id = "stochastic",
                          .label = fmt::format("{} times", stochastic_samples),
                          .order = 110,
                          .marker = "plus"},
                         true, {{"times", stochastic_samples}})
    {}

    void look_up(const range_shadow_map& map, std::span<const light_receiver> where,
                 std::span<float> visibility) const override
    {
        const bool covers = !map.texel_covers.empty();
        for (std::size_t i = 0; i < where.size(); ++i) {
            const float t = where[i].path.depth.t0;
            visibility[i] =
                covers ? cover_first_visibility_at(map, where[i], t) : visibility_at(map.map(), where[i], t);
        }
    }
};

const registered<stochastic_receiver> entry;

} // namespace

float visibility_at(const range_map<float>& map, const light_receiver& r, float t)
{
    return faces_at(r, t) ? 1 - intensity_at(map, r.path, t, 0.f) : 0;
}

float cover_first_visibility_at(const range_shadow_map& map, const light_receiver& r, float t)
{
    if (!faces_at(r, t)) return 0;
    const float z = range_depth(r.path.depth, t), id = r.path.depth.id, size = float(map.resolution);
    float shadow = 0;
    for_each_tap(receiver_path_at(r.path, t), [&](float column, float row, float weight) {
        if (!(column >= 0 && row >= 0 && column < size && row < size)) return;
        const std::size_t texel =
            range_map<float>::texel(std::size_t(map.resolution), std::size_t(column), std::size_t(row));
        const cover_answer<float> answer = range_cover_answer(map.texel_covers[texel], t, z, id, 0.f);
        float hidden = answer.intensity;
        if (answer.decided == 0)
            for (const auto& range : list_of(map, texel))
                hidden = std::max(hidden, range_intensity(range, t, z, id, 0.f));
        shadow += weight * hidden;
    });
    return 1 - saturate_or_zero(shadow);
}

} // namespace gnomon::evaluation
