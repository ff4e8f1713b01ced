// The input of methods: samples of what the light sees, by a seed, and maps of ranges. Each is made when it is first needed,
// and kept with the time that it took.
#pragma once

#include "evaluation/motion/map_source.hpp"
#include "renderer/raster/moving_samples.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

namespace gnomon::evaluation {

struct timed_samples {
    renderer::sample_picture of;
    double sampling_ms; // of one core
};

class layered_input {
  public:
    // The stage outlives the input. `resolution` is the usual one.
    layered_input(const renderer::moving_stage& its_stage, int its_resolution, std::uint32_t its_seed)
        : stage(its_stage), resolution(its_resolution), seed(its_seed)
    {}
    layered_input(const layered_input&) = delete;
    layered_input& operator=(const layered_input&) = delete;

    // So many samples in each texel of a map of so many texels a side. Valid until reseed().
    const timed_samples& samples(int each, int texels,
                                 renderer::sample_pattern pattern = renderer::sample_pattern::stratified);
    const timed_samples& samples(int each = 4) { return samples(each, resolution); }

    // Maps of ranges, which no seed changes: with another seed they are the same objects.
    map_source& ranges(int texels);
    map_source& ranges() { return ranges(resolution); }

    // Forgets all samples and begins those of another seed.
    void reseed(std::uint32_t with);

    const renderer::moving_stage& stage;
    const int resolution;
    std::uint32_t seed;

  private:
    std::map<std::tuple<int, int, renderer::sample_pattern>, timed_samples> samples_;
    std::map<int, map_source> ranges_;
};

} // namespace gnomon::evaluation
