// A stage as the drivers of hard shadows measure it: the shadow map's depths, the camera's picture, its receivers; and
// the references that visibilities are compared with.
#pragma once

#include "evaluation/core/method.hpp"
#include "evaluation/core/scene.hpp"
#include "evaluation/core/settings.hpp"

#include <gnomon/passes/blur.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

struct shaded_stage {
    shaded_stage(const renderer::stage& its_scenery, const settings& how);

    const renderer::stage& scenery;
    const std::array<float, 9> taps = gaussian_weights(); // of the blur
    depth_map depths;
    renderer::image<renderer::surface> seen;
    map_receivers where;
};

// A reference that knows the visibility of a stage's receivers.
class hard_reference : public reference {
  public:
    hard_reference(std::string its_id, std::string its_label, double its_order, bool it_uses_depths)
        : reference(std::move(its_id), std::move(its_label), its_order), uses_depths(it_uses_depths)
    {}

    virtual std::vector<float> visibility(const shaded_stage& stage, std::span<const map_receiver> where) const = 0;

    const bool uses_depths; // of receivers, with their bias, so that the reference without bias is another one
};

} // namespace gnomon::evaluation
