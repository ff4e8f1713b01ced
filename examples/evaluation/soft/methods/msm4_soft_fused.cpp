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
        if (moments4_kernels::occlusion(around, where.depth) > 1 - umbra_epsilon) return 1;
        const occluder_pair<float> two = fusion_occluders(hamburger4_distribution(around, where.depth));
        if (!(two.between > -1)) return one_occluder(around, light, where, read);
        const auto filtered = [&](const soft_widths<float>& widths) {
            return read.filter(soft_light::filter_rectangle(where, widths));
        };
        const soft_widths<float> first = light.penumbra(where.depth, two.first);
        const soft_widths<float> second = light.penumbra(where.depth, two.second);
        const channels4<float> far_light = filtered(first), near_light = filtered(second);
        const float receiver = biased_depth(where, second);
        // What parts the occluders must not lie behind the receiver's own plane.
        const float blocked =
            moments4_kernels::shadow(far_light, most, std::min(two.between, biased_depth(where, first)));
        const float covered = moments4_kernels::shadow(near_light, most, std::min(two.between, receiver));
        const float either = moments4_kernels::shadow(near_light, most, receiver);
        return over_darken(fusion_intensity(blocked, covered, either), 1 - umbra_epsilon);
    }
};

const registered<moments4_method<fused_shadow>> entry{method_facts{
    .id = "msm4_soft_fused", .family = "msm4", .label = "MSM soft, 4 moments, two occluders", .order = 260}};

} // namespace

} // namespace gnomon::evaluation
