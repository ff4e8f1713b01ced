// Time-dependent shadow maps of the samples that the light sees (Akenine-Moller et al. 2007), told apart by what a texel
// keeps of its sample for the depth bias.
#pragma once

#include "evaluation/core/timing.hpp"
#include "evaluation/layered/layered_method.hpp"

#include <gnomon/motion/layers/receiver_footprint.h>
#include <gnomon/passes/time_dependent.hpp>

#include <memory>
#include <vector>

namespace gnomon::evaluation {

template <class Texel> class sliced_map final : public layered_map {
  public:
    sliced_map(const timed_samples& from, int look_ups) : slices_(from.of.samples), look_ups_(look_ups)
    {
        resolution = from.of.width;
        sampling_ms = from.sampling_ms;
        texels_.resize(from.of.of.size());
        conversion_ms = 1e3 * seconds_on_one_core([&] { fill_time_dependent(from.of.map(), std::span(texels_)); });
    }

    std::size_t bytes() const override { return texels_.size() * sizeof(Texel); }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const auto size = std::size_t(resolution);
        const time_dependent_map<Texel> map{size, size, std::size_t(slices_), texels_};
        for (std::size_t i = 0; i < where.size(); ++i) {
            const stochastic_receiver& r = where[i];
            result[i] = 1 - time_dependent_intensity(
                                map, time_dependent_receiver<float>{r.x, r.y, r.depth, r.t, r.slope}, look_ups_);
        }
    }

    shutter_exposure<float> averaged(const stochastic_receiver& r) const override
    {
        return footprint_stratum(r.t, float(slices_));
    }

  private:
    int slices_, look_ups_;
    std::vector<Texel> texels_;
};

// "samples" for each texel; "scale", the side of the map over the usual one, 1 without it; "nearest" for the nearest texel,
// else 2 x 2.
template <class Texel> class time_slices final : public layered_method {
  public:
    using layered_method::layered_method;

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        const int texels = int(value_of(how, "scale", 1) * from.resolution);
        const bool nearest = value_of(how, "nearest", 0) != 0;
        return std::make_unique<sliced_map<Texel>>(from.samples(int(how.at("samples")), texels), nearest ? 0 : 1);
    }
};

} // namespace gnomon::evaluation
