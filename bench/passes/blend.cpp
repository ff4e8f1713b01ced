// Translucent occluders: a fragment that is blended into a map, by format, against one that is written as opaque; and
// shadows from blended texels and from absorbance, scalar, against those from texels that are stored once.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "support/hostile.hpp"
#include "support/stacks.hpp"

#include <gnomon/passes/blend.hpp>
#include <gnomon/storage/formats.hpp>

#include <array>
#include <memory>

namespace gnomon::bench {

namespace {

constexpr std::size_t side = 32, count = 4096;

/// Fragments of smoke all over a map that the nearest cache holds, back to front.
const std::vector<translucent_fragment>& smoke()
{
    static const auto fragments = [] {
        test::bit_source bits(1);
        std::vector<translucent_fragment> f(count);
        for (std::size_t i = 0; i < count; ++i)
            f[i] = {static_cast<std::uint32_t>(bits.below(side)), static_cast<std::uint32_t>(bits.below(side)),
                    0.5f - static_cast<float>(i) / count, static_cast<float>(bits.uniform(0.01, 0.5))};
        return f;
    }();
    return fragments;
}

/// The work of a pass that puts all fragments into a map of the format.
template <class Format, class Pass> work into_map(Pass pass)
{
    auto texels = std::make_shared<std::vector<format_texel<Format>>>(side * side, Format::clear());
    return {[=] { pass(map_view<format_texel<Format>>(*texels, side, side)); }, static_cast<double>(count)};
}

/// Fragments that are written as opaque ones, so that the last one of a texel is left.
template <class Format> work written()
{
    return into_map<Format>([](auto map) {
        for (const translucent_fragment& f : smoke()) map(f.x, f.y) = Format::encode(Format::from_depth(f.depth));
    });
}

template <class Format> bool add_blend()
{
    const std::string name = "blend/" + std::string(Format::id);
    return add_comparison(
        name.c_str(),
        [] { return into_map<Format>([](auto map) { blend<Format>(map, smoke(), float(alpha_test_one_percent)); }); },
        [] { return written<Format>(); });
}

/// Absorbance in any order, against the blends of 4 x 16 UNORM.
template <class Format> bool add_accumulation()
{
    const std::string name = "blend/" + std::string(Format::id);
    return add_comparison(
        name.c_str(),
        [] {
            return into_map<Format>([](auto map) {
                std::fill(map.texels.begin(), map.texels.end(), Format::clear());
                accumulate<Format>(map, smoke(), float(alpha_test_one_percent));
            });
        },
        [] { return into_map<moments4_unorm16>([](auto map) { blend<moments4_unorm16>(map, smoke()); }); });
}

/// Channels of blended stacks and a receiver for each.
template <class Format> struct seen {
    std::vector<format_channels<Format>> channels;
    std::vector<float> receivers, results;
};

template <class Format> std::shared_ptr<seen<Format>> stacks()
{
    auto s = std::make_shared<seen<Format>>();
    test::bit_source bits(2);
    for (std::size_t i = 0; i < resident_fragments; ++i) {
        const test::stack stack = test::any_stack(bits);
        std::array<format_texel<Format>, 1> texel{Format::clear()};
        for (std::size_t k = 0; k < stack.size(); ++k) {
            const translucent_fragment f{0, 0, float(stack.depths[k]), float(stack.alphas[k])};
            if constexpr (absorbance_format<Format>) accumulate<Format>({texel, 1, 1}, std::span(&f, 1));
            else blend<Format>({texel, 1, 1}, std::span(&f, 1));
        }
        s->channels.push_back(Format::decode(texel[0]));
        s->receivers.push_back(float(bits.uniform(-1, 1)));
    }
    s->results.resize(s->receivers.size());
    return s;
}

template <class Format, class Look> work looked_up(Look look)
{
    return {[s = stacks<Format>(), look] {
                for (std::size_t i = 0; i < s->results.size(); ++i)
                    s->results[i] = look(s->channels[i], s->receivers[i]);
            },
            static_cast<double>(resident_fragments)};
}

template <class Format> work once()
{
    return looked_up<Format>([](const auto& c, float z_f) { return Format::intensity(c, z_f); });
}

/// Shadows after blends, and the middle of both bounds, against the shadow of texels that are stored once.
template <class Format> bool add_intensity()
{
    const std::string id(Format::id);
    const auto middle = [](const auto& c, float z_f) {
        if constexpr (channel_count<Format> == 4)
            return bounds_intensity(hamburger4_bounds(Format::blended_factor(c, 100), z_f), 0.5f);
        else return bounds_intensity(hamburger6_bounds(Format::blended_factor(c, 100), z_f), 0.5f);
    };
    return add_comparison(("blended intensity/" + id).c_str(),
                          [] {
                              return looked_up<Format>(
                                  [](const auto& c, float z_f) { return Format::blended_intensity(c, 100, z_f); });
                          },
                          once<Format>) &&
           add_comparison(("blended intensity/" + id + ", middle of the bounds").c_str(),
                          [=] { return looked_up<Format>(middle); }, once<Format>);
}

template <class Format> bool add_transmittance()
{
    return add_comparison(
        ("blended intensity/" + std::string(Format::id)).c_str(),
        [] {
            return looked_up<Format>([](const auto& c, float z_f) { return 1 - Format::transmittance(c, 12, 1, z_f); });
        },
        once<moments4_unorm16>);
}

[[maybe_unused]] const bool registered = [] {
    return add_blend<variance_unorm16>() && add_blend<exponential_variance_half>() &&
           add_blend<exponential_variance_float>() && add_blend<moments4_unorm16>() && add_blend<moments4_half>() &&
           add_blend<moments4_float>() && add_blend<moments6_unorm10>() && add_blend<moments6_unorm16>() &&
           add_blend<moments6_float>() && add_accumulation<absorbance4_half>() &&
           add_accumulation<absorbance4_float>() && add_intensity<moments4_unorm16>() &&
           add_intensity<moments4_half>() && add_intensity<moments4_float>() && add_intensity<moments6_unorm16>() &&
           add_intensity<moments6_float>() && add_transmittance<absorbance4_half>() &&
           add_transmittance<absorbance4_float>();
}();

} // namespace

} // namespace gnomon::bench
