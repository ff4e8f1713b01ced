// How do you filter with a SIMD type of your own?
//
// A kernel is a template over its number type. Any pack will do that has the functions below, and each lane gets the
// bits that the kernel gives for it alone. This pack is a vector of GCC and Clang; wrap your engine's type alike.
#include "renderer/scene/stage.hpp"
#include "renderer/shade/receivers.hpp"
#include "renderer/shade/shading.hpp"

#include <gnomon/passes/look_up.hpp>
#include <gnomon/storage/formats.hpp>

#include <cstdio>

constexpr std::size_t lanes = 4, side = 1024; // of a pack, and of the shadow map
using floats [[gnu::vector_size(4 * lanes)]] = float;

struct mask { // what a comparison returns: all bits of a lane set, or none
    decltype(floats{} < floats{}) bits;
    friend mask operator&&(mask a, mask b) { return {a.bits & b.bits}; }
    friend mask operator||(mask a, mask b) { return {a.bits | b.bits}; }
    friend mask operator!(mask a) { return {~a.bits}; }
    friend bool any(mask a) { return (a.bits[0] | a.bits[1] | a.bits[2] | a.bits[3]) != 0; }
};

struct pack {
    using value_type = float; // of a lane
    floats v;
    pack(floats all) : v(all) {}
    explicit pack(float all = 0) : v(all - floats{}) {}
    friend pack operator-(pack a) { return -a.v; }
    friend pack operator+(pack a, pack b) { return a.v + b.v; }
    friend pack operator-(pack a, pack b) { return a.v - b.v; }
    friend pack operator*(pack a, pack b) { return a.v * b.v; }
    friend pack operator/(pack a, pack b) { return a.v / b.v; }
    friend mask operator<(pack a, pack b) { return {a.v < b.v}; }
    friend mask operator<=(pack a, pack b) { return {a.v <= b.v}; }
    friend mask operator==(pack a, pack b) { return {a.v == b.v}; }
    friend pack select(mask m, pack a, pack b) { return m.bits ? a.v : b.v; }
    friend pack abs(pack a) { return select(a < pack(0.0f), -a, a) + pack(0.0f); } // + 0 makes 0 of -0
    friend pack sqrt(pack a)
    {
        for (std::size_t k = 0; k < lanes; ++k) a.v[k] = std::sqrt(a.v[k]);
        return a;
    }
};

int main()
{
    using namespace gnomon::renderer;
    using format = gnomon::moments4_unorm16;
    const stage scenery = fence_stage(16.0 / 9.0); // and a map as in lesson 2, without the blur
    const auto depths = rasterize_depth<1>(scenery.world, scenery.light, side, side);
    std::vector<format::texel> texels(gnomon::mip_texels(side, side));
    for (std::size_t i = 0; i < depths.pixels.size(); ++i)
        texels[i] = format::encode(format::from_depth(depths.pixels[i][0]));
    gnomon::build_mips<format>({texels, side, side});
    const auto seen = rasterize_surfaces(scenery.world, scenery.eye, 960, 540);
    const receivers all = receivers_of(seen, scenery.light, side); // what faces the light, with the bias of lesson 2
    image<float> visibility(960, 540, 1.0f);
    std::size_t different = 0;
    for (std::size_t i = 0; i < all.size(); i += lanes) {
        const std::size_t count = std::min(lanes, all.size() - i);
        format::channels<float> one[lanes]{};
        pack c1, c2, c3, c4, depth;
        for (std::size_t k = 0; k < count; ++k) {
            const auto [u, v, level] = all.places[i + k];
            one[k] = gnomon::trilinear<format>({texels, side, side}, u * side, v * side, level);
            c1.v[k] = one[k].c1, c2.v[k] = one[k].c2, c3.v[k] = one[k].c3, c4.v[k] = one[k].c4;
            depth.v[k] = all.depths[i + k];
        }
        const pack intensity =
            format::filtered_intensity(format::channels<pack>{c1, c2, c3, c4}, depth); // four at once
        for (std::size_t k = 0; k < count; ++k) {
            visibility.pixels[all.pixels[i + k]] = 1 - intensity.v[k];
            different += intensity.v[k] != format::filtered_intensity(one[k], all.depths[i + k]);
        }
    }
    std::printf("%zu receivers, %zu differ from one at a time\n", all.size(), different);
    write_png("out/lessons/03_your_simd.png", shade(scenery.world, scenery.light, seen, visibility));
}
