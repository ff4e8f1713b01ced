// Overestimation of visibility that is one for all view rays, against the light and along it (Peters et al. 2017, Figure 14): the
// bounds themselves, and the middle between them.
#include "rectified_moments.hpp"

namespace gnomon::evaluation::scatter_bounds {

namespace {

template <overestimation weight>
using paper_method = rectified_method<moments4_unorm16, paper_options(rectified_source::texel), weight>;

const std::vector<std::string> scenes{"tower", "antipode"};

const registered<paper_method<overestimation::none>> least{
    method_facts{
        .id = "scatter4_unorm16_least", .family = "msm4", .label = "MSM4 64 bit, overestimation 0", .order = 330},
    scenes};
const registered<paper_method<overestimation::half>> half{
    method_facts{
        .id = "scatter4_unorm16_half", .family = "msm4", .label = "MSM4 64 bit, overestimation 1/2", .order = 331},
    scenes};
const registered<paper_method<overestimation::full>> most{
    method_facts{
        .id = "scatter4_unorm16_most", .family = "msm4", .label = "MSM4 64 bit, overestimation 1", .order = 332},
    scenes};

} // namespace

} // namespace gnomon::evaluation::scatter_bounds
