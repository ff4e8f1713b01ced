// The default with one setting each that is not the default's: the paper's measure of depth, its range of depth, its
// overestimation, and radii that end at the farthest visible surface. Rays to the sky end at the far plane, so that only a scene
// without sky has these radii. Polar angles are those of directions, so what is visible does not narrow them.
#include "rectified_moments.hpp"

namespace gnomon::evaluation::scatter_settings {

namespace {

using format = moments6_unorm16;

const std::vector<std::string> compared_in{"room", "trees", "tower", "antipode"};

constexpr rectified_options usual{}, polar{.depth = rectified_depth::polar}, frustum{.range_per_row = false},
    fitted{.fitted = true};

const registered<rectified_method<format, polar>> by_angle{
    method_facts{
        .id = "scatter6_unorm16_polar", .family = "msm6", .label = "MSM6 96 bit, depth by angle", .order = 330},
    compared_in};
const registered<rectified_method<format, frustum>> over_frustum{
    method_facts{
        .id = "scatter6_unorm16_frustum", .family = "msm6", .label = "MSM6 96 bit, range of the frustum", .order = 331},
    compared_in};
const registered<rectified_method<format, usual, overestimation::adaptive>> adaptive{
    method_facts{
        .id = "scatter6_unorm16_adaptive", .family = "msm6", .label = "MSM6 96 bit, adaptive weight", .order = 332},
    compared_in};
const registered<rectified_method<format, fitted>> to_visible{
    method_facts{
        .id = "scatter6_unorm16_fitted", .family = "msm6", .label = "MSM6 96 bit, fitted to the view", .order = 333},
    compared_in};

} // namespace

} // namespace gnomon::evaluation::scatter_settings
