// A filterable shadow map in a storage format of the library, looked up by the kernel that belongs to the format once two
// passes have filtered the map. A method over a format is a file with two lines: the registration of
// filterable<FORMAT>, and of its family where it is the family's first.
#pragma once

#include "evaluation/core/filtered_map.hpp"
#include "evaluation/core/timed_look_ups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

inline const registered<map_kind> filtered_map_kind{
    map_kind{.id = "filtered", .label = "filtered map with mip levels", .order = 20}};

template <storage_format Format> class filterable_map final : public shadow_map {
  public:
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
        return timed_look_ups<channels>(
            where, [this](const map_receiver& r) { return map_.fetch(r); },
            [](const auto& filtered, auto z_f) { return intensity(filtered, z_f); });
    }

    template <class Real> static Real intensity(const channels<Real>& filtered, Real z_f)
    {
        return Format::filtered_intensity(filtered, z_f);
    }

  private:
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
