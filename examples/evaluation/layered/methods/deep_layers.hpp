// Deep shadow maps: transmittance over depth for each texel, without time. Their receivers are static.
#pragma once

#include "evaluation/layered/layered_method.hpp"

#include <gnomon/passes/deep_shadow.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::evaluation {

inline constexpr double usual_deep_tolerance = 0.01; // of transmittance

class deep_layers : public layered_map {
  public:
    std::size_t bytes() const override { return first_.size() * sizeof first_[0] + layers_.size() * sizeof layers_[0]; }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const deep_shadow_map<float> map{std::size_t(resolution), std::size_t(resolution), first_, layers_};
        for (std::size_t i = 0; i < where.size(); ++i) {
            const stochastic_receiver& r = where[i];
            result[i] = 1 - deep_intensity(map, r.x, r.y, biased_surface_depth(r));
        }
    }

  protected:
    static float biased_surface_depth(const stochastic_receiver& r)
    {
        return r.depth - float(motion_bias_radius) * r.slope - 4e-6f;
    }

    // Of texels row by row, from all that counting and filling take before the table and before the layers.
    template <class... From> void compress(const From&... from)
    {
        first_.resize(std::size_t(resolution) * std::size_t(resolution) + 1);
        count_deep_layers(from..., std::span(first_));
        layers_.resize(first_.back());
        fill_deep_layers<float>(from..., first_, std::span(layers_));
        facts["layers per texel"] = double(layers_.size()) / double(first_.size() - 1);
    }

  private:
    std::vector<std::uint32_t> first_;
    std::vector<deep_layer<float>> layers_;
};

} // namespace gnomon::evaluation
