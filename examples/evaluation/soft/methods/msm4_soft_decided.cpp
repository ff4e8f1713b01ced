// Least and greatest depths of the search region decide most receivers before anything else is read.
#include "moments4_map.hpp"

namespace gnomon::evaluation {

namespace {

struct decided_first {
    static constexpr bool reads_depths = true;

    static decided_shadow<float> decided(const soft_light& light, const soft_receiver& where, auto& read)
    {
        const soft_widths<float> widest = light.penumbra(where.depth, -1.0f);
        const depth_interval depths = read.depths(soft_light::filter_rectangle(where, widest));
        const float least = where.depth - biased_depth(where, soft_widths<float>{1, 1});
        const float most = where.depth - biased_depth(where, widest);
        return depth_interval_shadow(depths.least, depths.greatest, where.depth, least, most);
    }

    float operator()(const soft_light& light, const soft_receiver& where, auto& read) const
    {
        const decided_shadow<float> found = decided(light, where, read);
        if (found.decided > 0) return found.intensity;
        const hankel4<float> around =
            moments4_kernels::region(read.search(light.search_rectangle(where)), light.most_texels());
        if (moments4_kernels::occlusion(around, where.depth) > 1 - umbra_epsilon) return 1;
        return one_occluder(around, light, where, read);
    }
};

const registered<moments4_method<decided_first>> entry{method_facts{
    .id = "msm4_soft_decided", .family = "msm4", .label = "MSM soft, 4 moments, min/max skip", .order = 250}};

} // namespace

} // namespace gnomon::evaluation
