// With the dynamic bias of Andersson et al. 2015, (12): samples move in depth to the receiver's time. 12 bytes for each.
#include "time_slices.hpp"

namespace gnomon::evaluation {

namespace {

const registered<time_slices<slice_motion<float>>> entry{
    method_facts{.id = "time_slices_motion",
                 .family = "time_slices",
                 .label = "time-dependent, dynamic bias",
                 .order = 31,
                 .map = slices_kind->id,
                 .format = {"f32_depth_motion", "32 bit depth, time and motion"}},
    std::vector<layered_variant>{
        {.parameters = {{"samples", 4}}, .comparisons = {equal_input}},
        {.parameters = {{"samples", 4}, {"nearest", 1}}, .label = "nearest texel", .comparisons = {of_settings}}}};

} // namespace

} // namespace gnomon::evaluation
