#include "layered_view.hpp"

#include "renderer/shade/receivers.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float least_penumbra = 0.02f;
constexpr int times_of_part = 32; // of exact visibility over a part of the shutter interval

} // namespace

layered_view::layered_view(const moving_stage& its_stage, const camera_sizes& its_size)
    : stage(its_stage),
      size(its_size),
      rays_(stage.world),
      is_penumbra_(std::size_t(size.width) * std::size_t(size.height))
{
    reference = rays_.photograph(stage.light, stage.eye, size.width, size.height, size.reference_times);
    for (std::size_t i = 0; i < reference.visibility.pixels.size(); ++i) {
        if (reference.coverage.pixels[i] < 1) continue;
        const float v = reference.visibility.pixels[i];
        if (least_penumbra < v && v < 1 - least_penumbra) penumbrae.push_back(pixels.size()), is_penumbra_[i] = 1;
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

const stochastic_receivers& seen_samples::receivers(int resolution, const std::vector<char>& pixels)
{
    const auto [found, is_new] = some_.try_emplace(resolution);
    if (is_new) found->second = receivers_in(pixels, of.seen, receivers(resolution));
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

std::vector<float> layered_view::of_penumbrae(const seen_samples& seen, std::span<const float> segments) const
{
    const std::vector<float> all = of_pixels(seen, segments);
    std::vector<float> result;
    for (const std::size_t i : penumbrae) result.push_back(all[i]);
    return result;
}

std::vector<float> layered_view::exact_in_penumbrae(const seen_samples& seen, const stochastic_receivers& receivers,
                                                    std::span<const shutter_exposure<float>> parts) const
{
    const triangle_numbers numbers(stage.world.open);
    std::vector<receiver> from;
    std::vector<float> times;
    std::vector<std::size_t> owners;
    std::vector<float> sums(parts.size()), shares(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const seen_segment& sample = seen.of.seen.segments[receivers.segments[i]];
        const seen_segment path = followed(stage.world, numbers[sample.triangle], sample);
        const int times_of_it = parts[i].begin < parts[i].end ? times_of_part : 1;
        shares[i] = 1 / float(times_of_it);
        for (int k = 0; k < times_of_it; ++k) {
            const float t = std::lerp(parts[i].begin, parts[i].end, (float(k) + 0.5f) * shares[i]);
            const receiver now{glm::mix(path.p0, path.p1, t), glm::normalize(glm::mix(path.n0, path.n1, t))};
            const glm::dvec3 to_light = direction_towards(stage.light.at(double(t)), glm::dvec3(now.position));
            if (glm::dot(to_light, glm::dvec3(now.normal)) > 0)
                from.push_back(now), times.push_back(t), owners.push_back(i);
        }
    }
    std::vector<float> visible(from.size());
    rays_.visibility(stage.light, from, times, visible);
    for (std::size_t k = 0; k < visible.size(); ++k) sums[owners[k]] += shares[owners[k]] * visible[k];
    return of_penumbrae(seen, of_segments(receivers, sums));
}

} // namespace gnomon::evaluation
