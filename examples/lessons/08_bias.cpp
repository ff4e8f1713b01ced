// What do a depth bias and over-darkening do to a shadow?
//
// A sloped receiver lies behind a part of its own filter region. Comparing depths, it shadows itself (acne), unless a
// depth bias moves it towards the light; a bound on the intensity needs less. Too much bias takes shadows from
// contacts. A bound leaves some light in deep shadows, too (leaking): over-darkening divides it away, and hardens soft
// edges.
#include "renderer/scene/stage.hpp"
#include "renderer/shade/receivers.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/trace/tracer.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/storage/formats.hpp>

#include <cstdio>
#include <vector>

using namespace gnomon::renderer;
using format = gnomon::moments4_unorm16;

constexpr int width = 960, height = 540, side = 512;

struct setting {
    const char* name;
    bool moments;   // or one comparison of depths
    float bias;     // in multiples of what the size of the filter and the receiver's slope ask for
    float strength; // of over-darkening: the intensity that becomes 1
};
constexpr setting settings[]{{"depths, no bias", false, 0, 1},
                             {"moments, no bias", true, 0, 1},
                             {"moments, bias", true, 1, 1},
                             {"moments, 5 x bias", true, 5, 1},
                             {"moments, over-darkened", true, 1, 0.8f}};

int main()
{
    const stage scenery = fence_stage(double(width) / height); // and a map as in lesson 2
    const auto depths = rasterize_depth<1>(scenery.world, scenery.light, side, side);
    std::vector<format::texel> texels(gnomon::mip_texels(side, side)), scratch(std::size_t(side) * side);
    for (std::size_t i = 0; i < depths.pixels.size(); ++i)
        texels[i] = format::encode(format::from_depth(depths.pixels[i][0]));
    const gnomon::mip_view<format::texel> mips{texels, side, side};
    gnomon::blur<format>(mips.level(0), {scratch, side, side}, mips.level(0), gnomon::gaussian_weights());
    gnomon::build_mips<format>(mips);

    const auto seen = rasterize_surfaces(scenery.world, scenery.eye, width, height);
    const receivers all = receivers_of(seen, scenery.light, side);
    const auto traced = traced_visibility(tracer(scenery.world), scenery.light, seen);

    std::printf("%-22s %s  %s\n", "", "darkness where lit", "light in shadow");
    std::vector<picture> insets;
    for (const setting& s : settings) {
        image<float> visibility(width, height, 1.0f);
        double dark = 0, lit = 0, leaked = 0, shadowed = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto [u, v, level] = all.places[i];
            const float depth = all.unbiased_depths[i], receiver = depth - s.bias * (depth - all.depths[i]);
            const auto filtered = gnomon::trilinear<format>(mips, u * side, v * side, level);
            const float bound = gnomon::over_darken(format::filtered_intensity(filtered, receiver), s.strength);
            const float depth_test = depths(int(u * side), int(v * side))[0] < receiver ? 1.0f : 0.0f;
            const float intensity = s.moments ? bound : depth_test;
            visibility.pixels[all.pixels[i]] = 1 - intensity;
            const bool in_light = traced.pixels[all.pixels[i]] > 0.5f;
            (in_light ? dark : leaked) += double(in_light ? intensity : 1 - intensity);
            (in_light ? lit : shadowed) += 1;
        }
        std::printf("%-22s %18.4f  %15.4f\n", s.name, dark / lit, leaked / shadowed);
        const picture whole = shade(scenery.world, scenery.light, seen, visibility);
        insets.push_back(magnify(whole, inset_around(scenery.interests[2], scenery.eye, 200, width, height), 2));
    }
    write_png("out/lessons/08_bias.png", side_by_side(insets));
}
