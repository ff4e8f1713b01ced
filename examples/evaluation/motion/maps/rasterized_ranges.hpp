// Maps that the rasterizer of motion makes in one go, told apart by its options. Their parameters may be "surfaces" and
// "totals".
#pragma once

#include "evaluation/motion/range_method.hpp"
#include "renderer/raster/moving_rasterizer.hpp"

namespace gnomon::evaluation {

class rasterized_ranges : public range_method {
  public:
    rasterized_ranges(method_facts facts, const renderer::range_options& how, range_method_facts of_ranges);

    range_shadow_map build(map_source& from, const evaluation::parameters& how) const override;

    const renderer::range_options options;
};

} // namespace gnomon::evaluation
