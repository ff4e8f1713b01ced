// A filterable shadow map in a storage format of the library: resolved from four samples, blurred in two passes, with
// mip levels (Peters et al. 2017, D.1 and D.2).
#pragma once

#include "percentage_closer.hpp"

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

template <storage_format Format> class filtered_map {
  public:
    using texel = typename Format::texel;

    filtered_map(const depth_map& depths, std::span<const float> taps)
        : filtered_map(depths, taps, [](map_view<texel>) {})
    {}

    // draw() draws into the resolved map before its filter passes.
    filtered_map(const depth_map& depths, std::span<const float> taps, const std::invocable<map_view<texel>> auto& draw)
        : width_(static_cast<std::size_t>(depths.width)),
          height_(static_cast<std::size_t>(depths.height)),
          texels_(mip_texels(width_, height_))
    {
        for (std::size_t i = 0; i < depths.pixels.size(); ++i) texels_[i] = resolved(depths.pixels[i]);
        const mip_view<texel> mips{texels_, width_, height_};
        const map_view<texel> map = mips.level(0);
        draw(map);
        std::vector<texel> scratch(map.texels.size());
        blur<Format>(map, {scratch, width_, height_}, map, taps);
        build_mips<Format>(mips);
    }

    std::size_t bytes() const { return texels_.size() * sizeof(texel); }

    // Filtered channels. Flattened, so that the compiler inlines look-ups of every format alike and their times compare.
    [[gnu::flatten]] auto fetch(const map_receiver& where) const
    {
        return trilinear<Format>({texels_, width_, height_}, where.u * static_cast<float>(width_),
                                 where.v * static_cast<float>(height_), where.level);
    }

  private:
    static texel resolved(const std::array<float, 4>& depths)
    {
        channel_array<Format> mean{};
        for (const float z : depths) {
            const auto channels = std::bit_cast<channel_array<Format>>(Format::from_depth(z));
            for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += 0.25f * channels[k];
        }
        return store_channels<Format>(mean);
    }

    std::size_t width_, height_;
    std::vector<texel> texels_;
};

} // namespace gnomon::evaluation
