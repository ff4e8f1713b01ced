// With the bias of the receiver's slope: 4 bytes for each sample.
#include "time_slices.hpp"

namespace gnomon::evaluation {

namespace {

const registered<time_slices<slice_depth<float>>> entry{
    method_facts{.id = "time_slices",
                 .family = "time_slices",
                 .label = "time-dependent",
                 .order = 30,
                 .map = slices_kind->id,
                 .format = {"f32_depth", "32 bit depth"}},
    std::vector<layered_variant>{
        {.parameters = {{"samples", 4}}, .comparisons = {equal_input}},
        {.parameters = {{"samples", 8}}, .label = "8 samples", .comparisons = {equal_time, of_settings}},
        {.parameters = {{"samples", 20}}, .label = "20 samples", .comparisons = {equal_memory, of_settings}},
        {.parameters = {{"samples", 4}, {"nearest", 1}}, .label = "nearest texel", .comparisons = {of_settings}},
        {.parameters = {{"samples", 16}}, .label = "16 samples", .comparisons = {of_settings}},
        {.parameters = {{"samples", 32}}, .label = "32 samples", .comparisons = {of_settings}}}};

} // namespace

} // namespace gnomon::evaluation
