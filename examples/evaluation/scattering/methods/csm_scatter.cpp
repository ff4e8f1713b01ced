// Prefiltered single scattering by convolution shadow maps of 32 coefficients (Klehm et al. 2014): with the settings of Peters et
// al. 2017, Sec. 5.5.1, and with depth and rows as moments have them by default. No offset, since there is no surface to keep lit.
#include "rectified_moments.hpp"

namespace gnomon::evaluation::csm_scatter {

namespace {

const registered<rectified_method<convolution_unorm8, paper_options(rectified_source::texel)>> paper{
    method_facts{.id = "scatter_csm_paper", .family = "csm", .label = "CSM 256 bit (paper)", .order = 300}};
const registered<rectified_method<convolution_unorm8, rectified_options{}>> usual{
    method_facts{.id = "scatter_csm", .family = "csm", .label = "CSM 256 bit", .order = 310}};

} // namespace

} // namespace gnomon::evaluation::csm_scatter
