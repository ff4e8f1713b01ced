// Time-dependent shadow maps of a moving scene (Akenine-Moller et al. 2007), which Hong & Oh and Andersson et al. 2015
// compare with, and the samples of a camera as their receivers.
#pragma once

#include "evaluation/core/method.hpp"
#include "evaluation/core/timing.hpp"
#include "renderer/raster/moving_samples.hpp"
#include "renderer/shade/moving_view.hpp"

#include <gnomon/passes/time_dependent.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

inline const registered<family> slices_family{
    family{.id = "time_slices", .label = "time-dependent shadow maps", .order = 210, .colour = "#d62728"}};
inline const registered<map_kind> slices_kind{
    map_kind{.id = "time_slices", .label = "stochastic shadow maps", .order = 130}};

// Slices of samples. The kind of texel decides the depth bias: slice_depth for the receiver's slope, slice_motion for the
// dynamic bias of Andersson et al., (12), and time_dependent_sample for slope and motion.
template <class Texel> struct time_slices_map {
    int resolution = 0, slices = 0;
    std::vector<Texel> texels;
    double filling_ms = 0; // of one core

    explicit time_slices_map(const renderer::sample_picture& from)
        : resolution(from.width), slices(from.samples), texels(from.of.size())
    {
        filling_ms = 1e3 * seconds_on_one_core([&] { fill_time_dependent(from.map(), std::span(texels)); });
    }

    std::size_t bytes() const { return texels.size() * sizeof(Texel); }
    time_dependent_map<Texel> map() const
    {
        return {std::size_t(resolution), std::size_t(resolution), std::size_t(slices), texels};
    }
};

// Samples that face the light, with depths that floats round away from the light at most, and the numbers of their
// segments. Samples that face away are dark.
struct slice_receivers {
    std::vector<time_dependent_receiver<float>> where;
    std::vector<std::uint32_t> segments;
};
slice_receivers slice_receivers_of(const renderer::seen_motion& samples, const renderer::moving_camera& light,
                                   int resolution);

// The visibility of each segment, by 2 x 2 texels, with a constant bias of signed depth beyond the map's own.
template <class Texel>
void slice_visibility(const time_slices_map<Texel>& slices, const slice_receivers& receivers, float constant,
                      std::span<float> of_segments)
{
    const time_dependent_map<Texel> map = slices.map();
    for (std::size_t i = 0; i < receivers.where.size(); ++i) {
        time_dependent_receiver<float> r = receivers.where[i];
        r.z -= constant;
        of_segments[receivers.segments[i]] = 1 - time_dependent_intensity(map, r);
    }
}

} // namespace gnomon::evaluation
