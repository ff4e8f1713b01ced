// Prefiltered single scattering with the settings of Peters et al. 2017, Sec. 5: depth is the polar angle over the range of the
// whole view frustum, and visibility is overestimated adaptively. Without filtering, and by filtered samples of a moment map.
#include "rectified_moments.hpp"

namespace gnomon::evaluation::scatter_paper {

namespace {

template <class Format, rectified_source source>
using paper_method = rectified_method<Format, paper_options(source), overestimation::adaptive>;

constexpr rectified_source one_texel = rectified_source::texel, filtered = rectified_source::moments;

const registered<paper_method<moments4_unorm16, one_texel>> four_64{
    method_facts{.id = "scatter4_unorm16_paper", .family = "msm4", .label = "MSM4 64 bit (paper)", .order = 300}};
const registered<paper_method<moments4_unorm16, filtered>> four_64_filtered{method_facts{
    .id = "scatter4_unorm16_paper_filtered", .family = "msm4", .label = "MSM4 64 bit, filtered (paper)", .order = 301}};
const registered<paper_method<moments6_unorm10, one_texel>> six_60{
    method_facts{.id = "scatter6_unorm10_paper", .family = "msm6", .label = "MSM6 60 bit (paper)", .order = 300}};
const registered<paper_method<moments6_unorm10, filtered>> six_60_filtered{method_facts{
    .id = "scatter6_unorm10_paper_filtered", .family = "msm6", .label = "MSM6 60 bit, filtered (paper)", .order = 301}};
const registered<paper_method<moments6_unorm16, one_texel>> six_96{
    method_facts{.id = "scatter6_unorm16_paper", .family = "msm6", .label = "MSM6 96 bit (paper)", .order = 302}};
const registered<paper_method<moments6_unorm16, filtered>> six_96_filtered{method_facts{
    .id = "scatter6_unorm16_paper_filtered", .family = "msm6", .label = "MSM6 96 bit, filtered (paper)", .order = 303}};

} // namespace

} // namespace gnomon::evaluation::scatter_paper
