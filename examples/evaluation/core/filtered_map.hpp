// A filterable shadow map in a storage format of the library: resolved from four samples, blurred in two passes, with
// mip levels (Peters et al. 2017, D.1 and D.2).
#pragma once

#include "percentage_closer.hpp"

#include <gnomon/moments/moments.h>
#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/mips.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// What filters average, before any transform of the format.
template <class Format> typename Format::moments moments_of_depth(float z)
{
    if constexpr (requires { Format::moments_of_depth(z); }) return Format::moments_of_depth(z);
    else if constexpr (std::same_as<typename Format::moments, moments4<float>>) return moments4_from_depth(z);
    else return moments6_from_depth(z);
}

template <class Format> class filtered_map {
  public:
    using texel = typename Format::texel;

    filtered_map(const depth_map& depths, std::span<const float> taps)
        : width_(static_cast<std::size_t>(depths.width)),
          height_(static_cast<std::size_t>(depths.height)),
          texels_(mip_texels(width_, height_))
    {
        for (std::size_t i = 0; i < depths.pixels.size(); ++i) texels_[i] = resolved(depths.pixels[i]);
        const mip_view<texel> mips{texels_, width_, height_};
        const map_view<texel> map = mips.level(0);
        std::vector<texel> scratch(map.texels.size());
        blur<Format>(map, {scratch, width_, height_}, map, taps);
        build_mips<Format>(mips);
    }

    std::size_t bytes() const { return texels_.size() * sizeof(texel); }

    auto fetch(const map_receiver& where) const
    {
        return trilinear<Format>({texels_, width_, height_}, where.u * static_cast<float>(width_),
                                 where.v * static_cast<float>(height_), where.level);
    }

  private:
    static texel resolved(const std::array<float, 4>& depths)
    {
        channel_array<Format> mean{};
        for (const float z : depths) {
            const auto moments = std::bit_cast<channel_array<Format>>(moments_of_depth<Format>(z));
            for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += 0.25f * moments[k];
        }
        return Format::encode(std::bit_cast<typename Format::moments>(mean));
    }

    std::size_t width_, height_;
    std::vector<texel> texels_;
};

} // namespace gnomon::evaluation
