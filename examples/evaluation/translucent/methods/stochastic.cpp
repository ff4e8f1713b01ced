#include "stochastic.hpp"

#include <algorithm>
#include <cstdint>

namespace gnomon::evaluation {

namespace {

// A number in [0, 1) that depends on the texel, the fragment, the sample and the seed alone, by the finalizer of
// SplitMix64.
float random(std::size_t texel, std::size_t fragment, std::size_t sample, std::uint32_t seed)
{
    std::uint64_t bits = (std::uint64_t{texel} << 24 | std::uint64_t{fragment} << 4 | std::uint64_t{sample}) +
                         0x9e3779b97f4a7c15u * (std::uint64_t{seed} + 1);
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return static_cast<float>((bits ^ (bits >> 31)) >> 40) * 0x1p-24f;
}

} // namespace

depth_map stochastic_depths(const translucent_occluders& occluders, const build_settings& how)
{
    depth_map result = occluders.opaque;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const auto fragments = occluders.translucent(i);
        for (std::size_t k = 0; k < fragments.size(); ++k) {
            const float alpha = opacity_for(how.of, fragments[k].opacity);
            if (alpha < how.least_alpha) continue;
            for (std::size_t s = 0; s < result.pixels[i].size(); ++s)
                if (random(i, k, s, how.seed) < alpha)
                    result.pixels[i][s] = std::min(result.pixels[i][s], fragments[k].depth);
        }
    }
    return result;
}

} // namespace gnomon::evaluation
