// The prisms of a moving scene (Hong & Oh; comparators/prism.h) drawn into a shadow map, row by row, by packs of texels.
// A comparator for the exact rasterizer of motion: on one thread, and once for each pass that a method needs.
#pragma once

#include "renderer/scene/moving_scene.hpp"

#include <gnomon/comparators/prism.h>
#include <gnomon/passes/range/map.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

using prism_pack = gnomon::pack<xsimd::batch<float>>;

class prism_rasterizer {
  public:
    // Triangles that are ever behind the light are left out. Depths are linear in view distance.
    prism_rasterizer(const renderer::moving_scene& world, const renderer::moving_camera& light, int resolution);

    // Calls visit(number of the triangle, place of the first lane, fragments) for each pack of texels of a row that
    // triangles of its prism come near; places count row by row. Lanes outside of the picture have no fragments.
    template <class Visit> void for_each_pack(const Visit& visit) const
    {
        for (const setup& s : setups_) {
            const drawn_prism p = drawn(s);
            for (int y = p.first_row; y <= p.last_row; ++y) visit_row(p, y, s.number, visit);
        }
    }

    // The texel of a map at a place.
    std::uint32_t texel(std::uint32_t place) const
    {
        const auto width = std::uint32_t(resolution_);
        return std::uint32_t(range_map<float>::texel(width, place % width, place / width));
    }

  private:
    static constexpr int triangles = 14;

    struct setup {
        prism<float> shape;
        std::uint32_t number;
    };
    struct interval {
        float low, high; // along a row; empty where low is more
    };
    struct drawn_prism {
        std::array<prism_triangle<float>, triangles> scalars;
        std::array<prism_triangle<prism_pack>, triangles> packs;
        int first_row, last_row;
    };

    drawn_prism drawn(const setup& s) const;
    static interval row_of(const prism_triangle<float>& v, float y);

    template <class Visit> void visit_row(const drawn_prism& p, int y, std::uint32_t number, const Visit& visit) const
    {
        constexpr int lanes = int(prism_pack::size);
        const float s_y = float(y) + 0.5f;
        std::array<interval, triangles> parts;
        interval whole{float(resolution_), -1};
        for (std::size_t k = 0; k < triangles; ++k) {
            parts[k] = row_of(p.scalars[k], s_y);
            if (parts[k].low > parts[k].high) continue;
            whole = {std::min(whole.low, parts[k].low), std::max(whole.high, parts[k].high)};
        }
        const int begin = int(std::max(whole.low, 0.f)), end = int(std::min(whole.high + 1, float(resolution_)));
        std::array<prism_fragment<prism_pack>, triangles> fragments;
        for (int x = begin; x < end; x += lanes) {
            std::array<float, prism_pack::size> centres;
            for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = float(x + int(i)) + 0.5f;
            const prism_pack s_x = prism_pack::load_unaligned(centres.data());
            const prism_pack inside =
                gnomon_select(s_x < prism_pack(float(resolution_)), prism_pack(1.f), prism_pack(0.f));
            std::size_t count = 0;
            for (std::size_t k = 0; k < triangles; ++k) {
                if (!(parts[k].low < float(x + lanes) && float(x) <= parts[k].high)) continue;
                prism_fragment<prism_pack> f = prism_fragment_at(p.packs[k], s_x, prism_pack(s_y), prism_pack(0.f));
                f.covered *= inside;
                if (gnomon_any(f.covered > prism_pack(0.f))) fragments[count++] = f;
            }
            if (count > 0) visit(number, std::uint32_t(y * resolution_ + x), std::span(fragments).first(count));
        }
    }

    int resolution_;
    std::vector<setup> setups_;
};

} // namespace gnomon::evaluation
