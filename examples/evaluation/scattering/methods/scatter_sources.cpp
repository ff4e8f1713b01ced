// The default with other sources of texels: one texel of the shadow map, and filtered samples of a map of four moments.
#include "rectified_moments.hpp"

namespace gnomon::evaluation::scatter_sources {

namespace {

const std::vector<std::string> scenes{"room", "gate"};

constexpr rectified_options one_texel{.source = rectified_source::texel}, moments{.source = rectified_source::moments};

const registered<rectified_method<moments4_unorm16, one_texel>> four_64{
    method_facts{.id = "scatter4_unorm16_texel", .family = "msm4", .label = "MSM4 64 bit, one texel", .order = 320},
    scenes};
const registered<rectified_method<moments4_unorm16, moments>> four_64_moments{
    method_facts{
        .id = "scatter4_unorm16_moments", .family = "msm4", .label = "MSM4 64 bit, from moments", .order = 321},
    scenes};
const registered<rectified_method<moments6_unorm16, one_texel>> six_96{
    method_facts{.id = "scatter6_unorm16_texel", .family = "msm6", .label = "MSM6 96 bit, one texel", .order = 320},
    scenes};
const registered<rectified_method<moments6_unorm16, moments>> six_96_moments{
    method_facts{
        .id = "scatter6_unorm16_moments", .family = "msm6", .label = "MSM6 96 bit, from moments", .order = 321},
    scenes};

} // namespace

} // namespace gnomon::evaluation::scatter_sources
