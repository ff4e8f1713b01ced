#include "layered_view.hpp"

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float least_penumbra = 0.02f;

} // namespace

layered_view::layered_view(const moving_stage& its_stage, const camera_sizes& its_size)
    : stage(its_stage), size(its_size)
{
    reference = tracer(stage.world).photograph(stage.light, stage.eye, size.width, size.height, size.reference_times);
    for (std::size_t i = 0; i < reference.visibility.pixels.size(); ++i) {
        if (reference.coverage.pixels[i] < 1) continue;
        const float v = reference.visibility.pixels[i];
        if (least_penumbra < v && v < 1 - least_penumbra) penumbrae.push_back(pixels.size());
        pixels.push_back(i);
        expected.push_back(v);
    }
}

void layered_view::reseed(std::uint32_t seed)
{
    if (held_.size() > 1) held_.pop_back();
    held_.emplace_back(stage, size, seed);
}

const stochastic_receivers& seen_samples::receivers(int resolution)
{
    const auto [found, is_new] = receivers_.try_emplace(resolution);
    if (is_new) found->second = stochastic_receivers_of(of, *stage_, resolution);
    return found->second;
}

std::vector<float> of_segments(const stochastic_receivers& receivers, std::span<const float> visibility)
{
    std::vector<float> result = receivers.visibility;
    for (std::size_t i = 0; i < visibility.size(); ++i) result[receivers.segments[i]] = visibility[i];
    return result;
}

std::vector<float> layered_view::of_pixels(const seen_samples& seen, std::span<const float> segments) const
{
    const image<float> all = mean_visibility(seen.of.seen, segments);
    std::vector<float> result;
    for (const std::size_t pixel : pixels) result.push_back(all.pixels[pixel]);
    return result;
}

} // namespace gnomon::evaluation
