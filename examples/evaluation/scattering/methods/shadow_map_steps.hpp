// A shadow map of depths for methods that look up points in air, one by one or by packs: a frame of one texel on the far plane
// around it, and places and depths of points in it.
#pragma once

#include "evaluation/scattering/view_rays.hpp"

#include <gnomon/numerics/unorm.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace gnomon::evaluation {

// The vector from one place in light axes to another, and a place, in texels of the framed map and its unit of depth.
template <class Real> struct map_vector {
    Real x, y, z;
};

// Texel is float, or std::uint16_t for codes of UNORM16, whose unit of depth is a code.
template <class Texel> class framed_depths {
  public:
    explicit framed_depths(const scattering_scene& scene)
        : map_(scene.map),
          width_(scene.depths.plain().width),
          height_(scene.depths.plain().height),
          texels_((width_ + 2) * (height_ + 2) + 1, texel_of(1))
    {
        const map_view<const float> depths = scene.depths.plain();
        for (std::size_t y = 0; y < height_; ++y)
            std::transform(&depths(0, y), &depths(0, y) + width_, &texels_[(y + 1) * (width_ + 2) + 1], texel_of);
    }

    std::size_t bytes() const { return texels_.size() * sizeof(Texel); }

    template <class Real> map_vector<Real> eye() const
    {
        return {Real(map_.x + 1), Real(map_.y + 1), Real(map_.z * depth_scale + depth_offset)};
    }
    template <class Real> map_vector<Real> vector(const Real& x, const Real& y, const Real& z) const
    {
        return {x * Real(map_.texels_x), y * Real(map_.texels_y), z * Real(map_.depths * depth_scale)};
    }

    // True if all lanes are inside the frame and before the far plane, so that they need no clamp.
    template <class Real> bool holds(const map_vector<Real>& p) const
    {
        const Real least(0), right(float(width_ + 2)), bottom(float(height_ + 2));
        return !gnomon_any(
            !(least <= p.x && p.x < right && least <= p.y && p.y < bottom && p.z <= Real(depth_scale + depth_offset)));
    }
    // Inside the frame, and not beyond the far plane, where the map has nothing that shadows.
    template <class Real> map_vector<Real> clamped(const map_vector<Real>& p) const
    {
        const auto within = [](const Real& x, std::size_t extent) {
            return gnomon_min(gnomon_max(x, Real(0)), Real(float(extent + 1)));
        };
        return {within(p.x, width_), within(p.y, height_), gnomon_min(p.z, Real(depth_scale + depth_offset))};
    }

    // The depth in the texel that holds the place, which is inside the frame.
    float at(float x, float y) const
    {
        return float(texels_[std::size_t(std::int32_t(y)) * (width_ + 2) + std::size_t(std::int32_t(x))]);
    }
    receiver_pack at(const receiver_pack& x, const receiver_pack& y) const
    {
        if constexpr (std::is_same_v<receiver_pack, xsimd::batch<float>> &&
                      std::endian::native == std::endian::little) {
            using indices = xsimd::batch<std::int32_t>;
            const indices i = xsimd::to_int(y) * indices(std::int32_t(width_ + 2)) + xsimd::to_int(x);
            if constexpr (std::is_same_v<Texel, float>) return receiver_pack::gather(texels_.data(), i);
            else { // two codes at a time, the one wanted to the low half
                const auto pairs = reinterpret_cast<const std::int32_t*>(texels_.data());
                const indices both = indices::gather(pairs, i >> 1);
                return xsimd::to_float((both >> ((i & indices(1)) << 4)) & indices(0xffff));
            }
        } else {
            alignas(receiver_pack) std::array<float, receiver_pack::size> columns, rows;
            x.store_aligned(columns.data()), y.store_aligned(rows.data());
            return gathered<std::type_identity_t, receiver_pack>(
                [&](std::size_t i) { return at(columns[i], rows[i]); });
        }
    }

  private:
    static constexpr bool is_float = std::is_same_v<Texel, float>;
    static constexpr float depth_scale = is_float ? 1 : 0.5f * 65535, depth_offset = is_float ? 0 : 0.5f * 65535;

    static Texel texel_of(float depth)
    {
        if constexpr (is_float) return depth;
        else return unorm_encode<16>(0.5f * depth + 0.5f);
    }

    light_map map_;
    std::size_t width_, height_;
    std::vector<Texel> texels_;
};

} // namespace gnomon::evaluation
