// A filterable shadow map in a storage format of the library, looked up by the kernel that belongs to the format once two
// passes have filtered the map. A method over a format is a file with two lines: the registration of
// filterable<FORMAT>, and of its family where it is the family's first.
#pragma once

#include "evaluation/core/filtered_map.hpp"
#include "evaluation/core/method.hpp"

#include <gnomon/simd/xsimd.hpp>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

inline const registered<map_kind> filtered_map_kind{
    map_kind{.id = "filtered", .label = "filtered map with mip levels", .order = 20}};

template <storage_format Format> class filterable_map final : public shadow_map {
  public:
    using pack = gnomon::pack<xsimd::batch<float>>;
    template <class Real> using channels = format_channels<Format, Real>;

    filterable_map(const depth_map& depths, std::span<const float> taps) : map_(depths, taps) {}

    std::size_t bytes() const override { return map_.bytes(); }

    void intensities(std::span<const map_receiver> where, std::span<float> result) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i) {
            result[i] = intensity(map_.fetch(where[i]), where[i].depth);
            asm volatile("" ::: "memory"); // one at a time, whatever the compiler could do with some methods' loops
        }
    }

    std::vector<timed_look_up> timed(std::span<const map_receiver> where) const override
    {
        return {one_by_one(where), by_packs(where)};
    }

    template <class Real> static Real intensity(const channels<Real>& filtered, Real z_f)
    {
        return Format::filtered_intensity(filtered, z_f);
    }

  private:
    template <class Real> struct fetched {
        channels<Real> filtered;
        Real depth;
    };

    template <class Real, class Fetch> timed_look_up timed_in(std::size_t receivers, int lanes, Fetch fetch) const
    {
        const std::size_t groups = receivers / std::size_t(lanes);
        std::vector<fetched<Real>> values(groups);
        tbb::parallel_for(std::size_t(0), groups, [&](std::size_t i) { values[i] = fetch(i); });
        const auto run = [=](const auto& value_of, std::span<float> result) {
            for (std::size_t i = 0; i < groups; ++i) {
                const fetched<Real>& f = value_of(i);
                const Real found = intensity(f.filtered, f.depth);
                if constexpr (std::is_same_v<Real, float>) result[i] = found;
                else found.store_unaligned(&result[i * std::size_t(lanes)]);
                asm volatile("" ::: "memory"); // one at a time, whatever the compiler could do with some methods' loops
            }
        };
        const std::size_t covered = groups * std::size_t(lanes);
        return {lanes,
                {covered,
                 [=, values = std::move(values)](std::span<float> result) {
                     run([&](std::size_t i) -> const fetched<Real>& { return values[i]; }, result);
                 }},
                {covered, [=](std::span<float> result) { run(fetch, result); }}};
    }

    timed_look_up one_by_one(std::span<const map_receiver> where) const
    {
        return timed_in<float>(where.size(), 1, [this, where](std::size_t i) {
            return fetched<float>{map_.fetch(where[i]), where[i].depth};
        });
    }

    // A pack of receivers at a time, as on a GPU. What is left over is not timed.
    timed_look_up by_packs(std::span<const map_receiver> where) const
    {
        constexpr std::size_t count = sizeof(channels<pack>) / sizeof(pack);
        return timed_in<pack>(where.size(), int(pack::size), [this, where](std::size_t group) {
            alignas(pack) std::array<std::array<float, pack::size>, count> lanes;
            alignas(pack) std::array<float, pack::size> depths;
            for (std::size_t lane = 0; lane < pack::size; ++lane) {
                const map_receiver& r = where[group * pack::size + lane];
                const auto one = std::bit_cast<std::array<float, count>>(map_.fetch(r));
                for (std::size_t k = 0; k < count; ++k) lanes[k][lane] = one[k];
                depths[lane] = r.depth;
            }
            return fetched<pack>{std::bit_cast<channels<pack>>(lanes), pack::load_aligned(depths.data())};
        });
    }

    filtered_map<Format> map_;
};

template <storage_format Format> class filterable final : public filterable_method {
  public:
    explicit filterable(method_facts facts, std::optional<device_form> form = {})
        : filterable_method(completed(std::move(facts)), std::move(form))
    {}

    std::unique_ptr<shadow_map> build(const depth_map& depths, std::span<const float> taps) const override
    {
        return std::make_unique<filterable_map<Format>>(depths, taps);
    }

    channels from_depth(float z) const override
    {
        return listed(Format::decode(Format::encode(Format::from_depth(z))));
    }
    channels store(const channels& mean) const override { return listed(Format::decode(Format::encode(texel(mean)))); }
    float intensity(const channels& filtered, float z_f) const override
    {
        return filterable_map<Format>::template intensity<float>(texel(filtered), z_f);
    }

  private:
    using texel_channels = format_channels<Format>;

    static method_facts completed(method_facts facts)
    {
        facts.map = filtered_map_kind->id;
        facts.format = {std::string(Format::id), std::string(Format::name), double(Format::bytes_per_texel)};
        return facts;
    }
    static channels listed(const texel_channels& one)
    {
        const auto values = std::bit_cast<channel_array<Format>>(one);
        return {values.begin(), values.end()};
    }
    static texel_channels texel(const channels& values)
    {
        channel_array<Format> result{};
        if (values.size() != result.size())
            throw std::invalid_argument(fmt::format("channels: {} given, {} expected", values.size(), result.size()));
        std::ranges::copy(values, result.begin());
        return std::bit_cast<texel_channels>(result);
    }
};

} // namespace gnomon::evaluation
