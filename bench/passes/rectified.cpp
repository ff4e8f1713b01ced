// Passes over rectified maps on one core: prefix averages against one memcpy of the map's bytes, resampling with filters against
// one texel, look-ups of view rays against trilinear ones; and rows of texels against texel by texel. Maps of 1024 x 1024
// texels, of which 16 rows are resampled.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/rectify.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/storage/formats.hpp>

#include <cstring>

namespace gnomon::bench {

namespace {

constexpr std::size_t side = 1024, resampled = 16, places = 1024;

/// A light's map of blocks of depths, with its moments, and a frame that looks across it.
struct light_scene {
    using moments = moments4_unorm16;
    std::vector<float> depths = std::vector<float>(side * side);
    std::vector<moments::texel> texels = std::vector<moments::texel>(mip_texels(side, side));
    light_map light{10, 512, 0, 1, 1, 0.002f};
    rectified_frame frame{1000, -0.5f, 1, rectified_depth::polar};
    std::vector<rectified_row> rows = std::vector<rectified_row>(side);

    light_scene()
    {
        test::bit_source bits(1);
        std::array<float, 64 * 64> blocks;
        for (float& z : blocks) z = static_cast<float>(bits.chance(0.3) ? 1 : bits.uniform(-1, 1));
        for (std::size_t k = 0; k < depths.size(); ++k) {
            depths[k] = blocks[k / side / 16 * 64 + k % side / 16];
            texels[k] = moments::encode(moments::from_depth(depths[k]));
        }
        build_mips<moments>({texels, side, side});
        rectified_rows(frame, rectified_frustum<float>{1000, -0.5f, 1, 1, 2}, 0.001f, side, rows);
    }
    static const light_scene& get()
    {
        static const light_scene s;
        return s;
    }
};

/// A rectified map of the format.
template <class Format> class rectified_work {
  public:
    static rectified_work& get()
    {
        static rectified_work w;
        return w;
    }
    template <class Pass> work over_map(std::size_t count, Pass pass)
    {
        return {[this, pass, count] { pass(map(), row_range{0, count}); }, static_cast<double>(side * count)};
    }
    work copy()
    {
        return over_map(side, [this](auto, auto) {
            std::memcpy(copy_.data(), texels_.data(), copy_.size() * sizeof copy_[0]);
            asm volatile("" : : "r"(copy_.data()) : "memory");
        });
    }
    work prefix()
    {
        return over_map(side,
                        [](auto map, auto band) { transmittance_prefix<Format>(map, light_scene::get().rows, band); });
    }
    work one_texel()
    {
        return over_map(resampled, [&s = light_scene::get()](auto map, auto band) {
            rectify<Format>({s.depths, side, side}, s.light, s.frame, s.rows, map, band);
        });
    }
    work filtered()
    {
        return over_map(resampled, [&s = light_scene::get()](auto map, auto band) {
            rectify_filtered<Format>({s.depths, side, side}, s.light, s.frame, s.rows, map, band);
        });
    }
    work of_moments()
    {
        return over_map(resampled, [&s = light_scene::get()](auto map, auto band) {
            rectify_moments<Format, light_scene::moments>({s.texels, side, side}, s.light, s.frame, s.rows, map, band);
        });
    }
    work rows()
    {
        return over_map(resampled, [this](auto map, auto band) {
            for (std::size_t v = band.first; v < band.last; ++v) {
                load_row<Format>(&map(0, v), numbers_.data(), side);
                store_row<Format>(numbers_.data(), &map(0, v), side);
            }
        });
    }
    work texel_by_texel()
    {
        return over_map(resampled, [this](auto map, auto band) {
            for (std::size_t v = band.first; v < band.last; ++v) {
                for (std::size_t u = 0; u < side; ++u) channels_[u] = load_channels<Format>(map(u, v));
                for (std::size_t u = 0; u < side; ++u) map(u, v) = store_channels<Format>(channels_[u]);
            }
        });
    }
    work view_rays()
    {
        return look_ups([&s = light_scene::get()](auto mips, const auto& p) {
            return rectified_channels<Format>(mips, s.frame, s.rows, p, 0.5f);
        });
    }
    work trilinear_samples()
    {
        return look_ups([](auto mips, const auto& p) {
            return trilinear<Format>(mips, p.radius, (p.azimuth + 0.5f) * side, 0.5f);
        });
    }

  private:
    rectified_work() : texels_(mip_texels(side, side)), copy_(side * side), numbers_(side * channel_count<Format>)
    {
        test::bit_source bits(2);
        one_texel().run();
        prefix().run();
        build_mips<Format>({texels_, side, side});
        for (auto& p : positions_)
            p = {static_cast<float>(bits.uniform(0, 1000)), static_cast<float>(bits.uniform(-0.5, 0.5)), 1.5f};
    }
    map_view<format_texel<Format>> map() { return {std::span(texels_).first(side * side), side, side}; }

    template <class LookUp> work look_ups(LookUp look_up)
    {
        return {[this, look_up] {
                    const mip_view<const format_texel<Format>> mips{texels_, side, side};
                    for (const auto& p : positions_) {
                        auto c = look_up(mips, p);
                        asm volatile("" : : "r"(&c) : "memory");
                    }
                },
                places};
    }

    std::vector<format_texel<Format>> texels_, copy_;
    std::vector<float> numbers_;
    std::array<channel_array<Format>, side> channels_;
    std::array<rectified_position<float>, places> positions_;
};

template <class Format> bool add_format_rows()
{
    using w = rectified_work<Format>;
    const auto add = [](const char* what, auto measured, auto baseline) {
        return add_comparison(("rectified/" + std::string(Format::id) + what).c_str(), measured, baseline);
    };
    const auto one_texel = [] { return w::get().one_texel(); };
    return add(
               "/prefix averages against memcpy", [] { return w::get().prefix(); }, [] { return w::get().copy(); }) &&
           add(
               "/4 x 4 texels against one", [] { return w::get().filtered(); }, one_texel) &&
           add(
               "/two depths of moments against one texel", [] { return w::get().of_moments(); }, one_texel) &&
           add("/one texel against memcpy", one_texel, [] { return w::get().copy(); }) &&
           add(
               "/view rays against trilinear", [] { return w::get().view_rays(); },
               [] { return w::get().trilinear_samples(); }) &&
           add(
               "/rows against texel by texel", [] { return w::get().rows(); },
               [] { return w::get().texel_by_texel(); });
}

[[maybe_unused]] const bool registered = add_format_rows<moments4_unorm16>() && add_format_rows<moments4_float>() &&
                                         add_format_rows<moments6_unorm10>() && add_format_rows<moments6_unorm16>() &&
                                         add_format_rows<moments6_float>() && add_format_rows<convolution_unorm8>();

} // namespace

} // namespace gnomon::bench
