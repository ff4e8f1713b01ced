// Two occluders keep a penumbra each where the search region shows both, which mends Figure 10 of Peters et al. 2017 there.
#include "moments4_map.hpp"

#include <gnomon/soft/fusion.h>

namespace gnomon::evaluation {

namespace {

struct fused_shadow {
    static constexpr bool reads_depths = false;

    float operator()(const soft_light& light, const soft_receiver& where, auto& read) const
    {
        const float most = light.most_texels();
        const hankel4<float> around = moments4_kernels::region(read.search(light.search_rectangle(where)), most);
        if (moments4_kernels::intensity(around, where.depth) > 1 - umbra_epsilon) return 1;
        const occluder_pair<float> two = fusion_occluders(hamburger4_distribution(around, where.depth));
        if (!(two.between > -1)) return one_occluder(around, light, where, read);
        const auto filtered = [&](const soft_widths<float>& widths) {
            return moments4_kernels::region(read.filter(soft_light::filter_rectangle(where, widths)), most);
        };
        const soft_widths<float> widths = light.penumbra(where.depth, two.second);
        const hankel4<float> first = filtered(light.penumbra(where.depth, two.first)), second = filtered(widths);
        return over_darken(fusion_intensity(moments4_kernels::intensity(first, two.between),
                                            moments4_kernels::intensity(second, two.between),
                                            moments4_kernels::intensity(second, biased_depth(where, widths))),
                           1 - umbra_epsilon);
    }
};

const registered<moments4_method<fused_shadow>> entry{method_facts{
    .id = "msm4_soft_fused", .family = "msm4", .label = "MSM soft, 4 moments, two occluders", .order = 260}};

} // namespace

} // namespace gnomon::evaluation
