#include "evaluation/scattering/hazy_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<hazy_scene> entry{
    scene_facts{.id = "trees",
                .label = "among trees",
                .order = 210,
                .text =
                    "After Figure 16 of the paper: the shadows of leaves make many short lit segments on every view "
                    "ray. Ray marching is noisy, convolution shadow maps ring in dark circles, and moments draw "
                    "shadows with edges that are too sharp, six moments less so."},
    renderer::trees_stage,
    std::vector<paper_figure>{
        {"16",
         {"ray_march_128_unorm16", "scatter_csm", "scatter4_unorm16_paper", "scatter6_unorm10_paper"},
         "Noise by ray marching, ringing by convolution, sharp boundaries of shadows by four moments, weaker ones by "
         "six."}}};

} // namespace

} // namespace gnomon::evaluation
