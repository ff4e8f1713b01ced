// One method on one view: its shadows by either bound, shown as they are or divided, and what they cost.
#pragma once

#include "evaluation/core/timed_look_ups.hpp"
#include "method.hpp"
#include "view.hpp"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// How bounds become the shadow that is shown.
struct showing {
    const char *id, *label;
    bound in_smoke; // surfaces show the lower bound
    float strength; // by which intensities are divided (over_darken)

    evaluation::parameters parameters() const;
};
inline constexpr std::array<showing, 4> showings{{{"lower", "lower bound", bound::lower, 1},
                                                  {"divided", "lower bound, divided by 95%", bound::lower, 0.95f},
                                                  {"middle", "middle in smoke", bound::middle, 1},
                                                  {"both", "middle in smoke, divided by 95%", bound::middle, 0.95f}}};

// The colours of light that a method knows.
std::span<const colour> colours_of(const translucent_method& m);

// Shadow intensities at the receivers of a view, for each colour that the method knows.
struct shadows {
    std::vector<numbers> lower, middle; // the second of receivers in smoke alone

    // Visibility of the colour with this index.
    numbers visibility(const translucent_view& view, std::size_t of, const showing& how) const;
};

shadows shadows_of(const translucent_method& m, const translucent_map& map, const translucent_view& view);

struct measured_map {
    std::unique_ptr<translucent_map> map;
    double build_ms = 0; // on one core
};

measured_map build(const translucent_method& m, const translucent_occluders& occluders, std::span<const float> taps,
                   const build_settings& how = {});

// Times of look-ups of up to 2^16 receivers, half of them surfaces where the view has as many.
std::vector<measured_time> times_of(const translucent_map& map, const translucent_view& view);

} // namespace gnomon::evaluation
