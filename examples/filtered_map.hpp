// A filterable shadow map: resolved from four samples, blurred in two passes, with mip levels, kept in its storage
// format throughout and so rounded after every step, as on a GPU (Peters et al. 2017, D.1 and D.2).
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "percentage_closer.hpp"

namespace gnomon::demo {

// Linearly filterable channels, and the texel that stores them.
template <class S>
concept storage = requires(typename S::texel texel, typename S::channels channels, float z)
{
    {
        S::values_of_depth(z)
        } -> std::same_as<typename S::channels>; // before any transform of the format
    {
        S::encode_values(channels)
        } -> std::same_as<typename S::texel>;
    {
        S::encode(channels)
        } -> std::same_as<typename S::texel>;
    {
        S::decode(texel)
        } -> std::same_as<typename S::channels>;
    {
        channels[0]
        } -> std::same_as<float&>;
};

template <storage S> class filtered_map {
  public:
    using channels = typename S::channels;

    filtered_map(const depth_map& depths, std::span<const float> taps)
    {
        const level_map resolved = made(depths.width, depths.height, [&](int x, int y) {
            channels sum{};
            for (const float z : depths(x, y)) add(sum, S::values_of_depth(z), 0.25f);
            return S::encode_values(sum);
        });
        levels_.push_back(blurred(blurred(resolved, taps, 1, 0), taps, 0, 1));
        while (levels_.back().width > 1) {
            const level_map& fine = levels_.back();
            levels_.push_back(made(fine.width / 2, fine.height / 2, [&](int x, int y) {
                channels sum{};
                for (const int k : {0, 1, 2, 3}) add(sum, S::decode(fine(2 * x + k % 2, 2 * y + k / 2)), 0.25f);
                return S::encode(sum);
            }));
        }
    }

    channels trilinear(const look_up& place) const
    {
        const float level = std::min(place.level, static_cast<float>(levels_.size() - 1)), fine = std::floor(level);
        const std::size_t l = static_cast<std::size_t>(fine);
        channels sum{};
        add(sum, bilinear(levels_[l], place.u, place.v), 1 - (level - fine));
        if (level > fine) add(sum, bilinear(levels_[l + 1], place.u, place.v), level - fine);
        return sum;
    }

  private:
    using level_map = toolbox::image<typename S::texel>;

    static void add(channels& sum, const channels& c, float weight)
    {
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * c[k];
    }

    static level_map made(int width, int height, auto&& texel_at)
    {
        level_map result(width, height);
        tbb::parallel_for(0, height, [&](int y) {
            for (int x = 0; x < width; ++x) result(x, y) = texel_at(x, y);
        });
        return result;
    }

    static level_map blurred(const level_map& source, std::span<const float> taps, int dx, int dy)
    {
        const int radius = static_cast<int>(taps.size() / 2);
        return made(source.width, source.height, [&](int x, int y) {
            channels sum{};
            for (int t = -radius; t <= radius; ++t)
                add(sum,
                    S::decode(source(std::clamp(x + t * dx, 0, source.width - 1),
                                     std::clamp(y + t * dy, 0, source.height - 1))),
                    taps[static_cast<std::size_t>(t + radius)]);
            return S::encode(sum);
        });
    }

    static channels bilinear(const level_map& map, float u, float v)
    {
        const float x = u * static_cast<float>(map.width) - 0.5f, y = v * static_cast<float>(map.height) - 0.5f;
        const float left = std::floor(x), top = std::floor(y);
        channels sum{};
        for (const int j : {0, 1})
            for (const int i : {0, 1})
                add(sum,
                    S::decode(map(std::clamp(static_cast<int>(left) + i, 0, map.width - 1),
                                  std::clamp(static_cast<int>(top) + j, 0, map.height - 1))),
                    (i ? x - left : 1 - (x - left)) * (j ? y - top : 1 - (y - top)));
        return sum;
    }

    std::vector<level_map> levels_;
};

} // namespace gnomon::demo
