#include "slices.hpp"

#include "light_receivers.hpp"

namespace gnomon::evaluation {

using namespace renderer;

slice_receivers slice_receivers_of(const seen_motion& samples, const moving_camera& light, int resolution)
{
    const std::vector<light_receiver> here = light_receivers_of(samples, light, resolution, 0),
                                      texel_nearer = light_receivers_of(samples, light, resolution, 1);
    slice_receivers result;
    for (std::size_t i = 0; i < here.size(); ++i) {
        const receiver_path<float>& path = here[i].path;
        if (!(here[i].facing.begin < here[i].facing.end)) continue;
        const float z = path.depth.z0;
        result.where.push_back(
            {path.x0 / path.w0, path.y0 / path.w0, z, path.depth.t0, z - texel_nearer[i].path.depth.z0});
        result.segments.push_back(std::uint32_t(i));
    }
    return result;
}

} // namespace gnomon::evaluation
