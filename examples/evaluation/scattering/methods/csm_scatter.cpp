// Prefiltered single scattering by convolution shadow maps of 32 coefficients (Klehm et al. 2014), with the settings of Peters
// et al. 2017, Sec. 5.5.1: no offset, since there is no surface to keep lit; depth and rows as for moments.
#include "rectified_moments.hpp"

namespace gnomon::evaluation {

namespace {

constexpr rectified_options one_texel{.source = rectified_source::texel};

const registered<rectified_method<convolution_unorm8, one_texel>> csm{
    method_facts{.id = "scatter_csm", .family = "csm", .label = "CSM 256 bit", .order = 300}};

} // namespace

} // namespace gnomon::evaluation
