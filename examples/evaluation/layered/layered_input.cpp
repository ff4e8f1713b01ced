#include "layered_input.hpp"

#include "evaluation/core/timing.hpp"

#include <utility>

namespace gnomon::evaluation {

const timed_samples& layered_input::samples(int each, int texels, renderer::sample_pattern pattern)
{
    const std::tuple key(each, texels, pattern);
    if (const auto found = samples_.find(key); found != samples_.end()) return found->second;
    timed_samples made;
    made.sampling_ms = 1e3 * seconds_on_one_core([&] {
                           made.of = renderer::rasterize_samples(stage.world, stage.light, texels, texels,
                                                                 {.samples = each, .seed = seed, .pattern = pattern});
                       });
    return samples_.emplace(key, std::move(made)).first->second;
}

map_source& layered_input::ranges(int texels)
{
    return ranges_.try_emplace(texels, stage.world, stage.light, texels).first->second;
}

void layered_input::reseed(std::uint32_t with)
{
    samples_.clear();
    seed = with;
}

} // namespace gnomon::evaluation
