// Prefiltered single scattering as the library does it by default, in every format: 16 texels of the shadow map for each texel,
// the cosine of the polar angle for depth, a range of depth for each row, and overestimation of visibility by 1/2 but near the
// ray into the light.
#include "rectified_moments.hpp"

namespace gnomon::evaluation::scatter_default {

namespace {

constexpr rectified_options usual{};

const registered<rectified_method<moments4_unorm16, usual>> four_64{
    method_facts{.id = "scatter4_unorm16", .family = "msm4", .label = "MSM4 64 bit", .order = 310}};
const registered<rectified_method<moments4_float, usual>> four_128{
    method_facts{.id = "scatter4_float", .family = "msm4", .label = "MSM4 128 bit", .order = 311}};
const registered<rectified_method<moments6_unorm10, usual>> six_60{
    method_facts{.id = "scatter6_unorm10", .family = "msm6", .label = "MSM6 60 bit", .order = 310}};
const registered<rectified_method<moments6_unorm16, usual>> six_96{
    method_facts{.id = "scatter6_unorm16", .family = "msm6", .label = "MSM6 96 bit", .order = 311}};
const registered<rectified_method<moments6_float, usual>> six_192{
    method_facts{.id = "scatter6_float", .family = "msm6", .label = "MSM6 192 bit", .order = 312}};

} // namespace

} // namespace gnomon::evaluation::scatter_default
