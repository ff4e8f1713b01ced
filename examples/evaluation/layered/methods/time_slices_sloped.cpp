// With the dynamic bias, and that of the receiver's slope along the motion of a sample over the map, slope (1 + 1.5
// |d_xy| |t_r - t_i|): 16 bytes for each sample.
#include "time_slices.hpp"

namespace gnomon::evaluation {

namespace {

const registered<time_slices<time_dependent_sample<float>>> entry{
    method_facts{.id = "time_slices_sloped",
                 .family = "time_slices",
                 .label = "time-dependent, bias for slope and motion",
                 .order = 32,
                 .map = slices_kind->id,
                 .format = {"f32_depth_travel", "32 bit depth, time, motion in depth and in texels"}},
    std::vector<layered_variant>{
        {.parameters = {{"samples", 4}}, .comparisons = {equal_input}},
        {.parameters = {{"samples", 8}}, .label = "8 samples", .comparisons = {equal_time, equal_memory, of_settings}},
        {.parameters = {{"samples", 8}, {"scale", 1.5}},
         .label = "8 samples, 1.5 x the side",
         .comparisons = {equal_time}},
        {.parameters = {{"samples", 4}, {"nearest", 1}}, .label = "nearest texel", .comparisons = {of_settings}},
        {.parameters = {{"samples", 16}}, .label = "16 samples", .comparisons = {equal_time, of_settings}},
        {.parameters = {{"samples", 20}}, .label = "20 samples", .comparisons = {of_settings}},
        {.parameters = {{"samples", 32}}, .label = "32 samples", .comparisons = {of_settings}},
        {.parameters = {{"samples", 4}, {"scale", 0.5}}, .label = "of half the map", .comparisons = {of_settings}},
        {.parameters = {{"samples", 4}, {"scale", 2}}, .label = "of twice the map", .comparisons = {of_settings}}}};

} // namespace

} // namespace gnomon::evaluation
