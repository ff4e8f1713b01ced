// The view of a scene's camera: the reference, its pixels and penumbrae, and samples with their receivers, of one seed after
// the other.
#pragma once

#include "layered_input.hpp"
#include "layered_method.hpp"
#include "renderer/scene/moving_scene.hpp"
#include "renderer/trace/tracer.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace gnomon::evaluation {

struct camera_sizes {
    int width, height, samples; // of a pixel
    int reference_times;
};

// Samples of one seed, and their receivers in maps of so many texels a side.
class seen_samples {
  public:
    // The stage outlives the samples.
    seen_samples(const renderer::moving_stage& stage, const camera_sizes& size, std::uint32_t seed)
        : of(camera_samples_of(stage, size.width, size.height, size.samples, seed)), stage_(&stage)
    {}

    const stochastic_receivers& receivers(int resolution);

    // Those in the pixels that have true in the mask, which is always the same one.
    const stochastic_receivers& receivers(int resolution, const std::vector<char>& pixels);

    camera_samples of;

  private:
    const renderer::moving_stage* stage_;
    std::map<int, stochastic_receivers> receivers_, some_;
};

// The visibility of each segment from that of each receiver.
std::vector<float> of_segments(const stochastic_receivers& receivers, std::span<const float> visibility);

class layered_view {
  public:
    // The stage outlives the view.
    layered_view(const renderer::moving_stage& its_stage, const camera_sizes& its_size);

    // Begins the samples of another seed. Those of the first seed are kept.
    void reseed(std::uint32_t seed);

    seen_samples& now() { return held_.size() > 1 ? held_[1] : held_[0]; }
    seen_samples& first() { return held_[0]; }

    // The mean visibility of each of `pixels`, and of those in penumbrae.
    std::vector<float> of_pixels(const seen_samples& seen, std::span<const float> segments) const;
    std::vector<float> of_penumbrae(const seen_samples& seen, std::span<const float> segments) const;

    // The receivers of pixels in penumbrae.
    const stochastic_receivers& in_penumbrae(seen_samples& seen, int resolution) const
    {
        return seen.receivers(resolution, is_penumbra_);
    }

    // The mean visibility of each pixel in penumbrae, by ray tracing: that of a receiver over a part of the shutter
    // interval, while its point moves with its surface.
    std::vector<float> exact_in_penumbrae(const seen_samples& seen, const stochastic_receivers& receivers,
                                          std::span<const shutter_exposure<float>> parts) const;

    const renderer::moving_stage& stage;
    const camera_sizes size;
    renderer::reference_picture reference;
    std::vector<std::size_t> pixels;    // that see a surface all of the time
    std::vector<std::size_t> penumbrae; // indices into `pixels` of those that see the light for a part of the time
    std::vector<float> expected;        // visibility of each of `pixels`

  private:
    renderer::tracer rays_;
    std::vector<char> is_penumbra_; // of all pixels of the picture
    std::vector<seen_samples> held_;
};

} // namespace gnomon::evaluation
