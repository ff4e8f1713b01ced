// How each method of the demo that this example renders is stored and set on a device. Everything that belongs to a
// format comes from the library's type of it.
#pragma once

#include "evaluation/core/method.hpp"
#include "evaluation/vulkan/shaders/method_id.h"
#include "renderer.hpp"

#include <gnomon/storage/formats.hpp>

#include <map>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// The methods of the registry that have a device form.
inline std::vector<const filterable_method*> device_methods()
{
    std::vector<const filterable_method*> result;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const filterable_method*>(m); one && one->device) result.push_back(one);
    return result;
}

inline const device_method& on_device(const filterable_method& m)
{
    using format = vk::Format;
    static const std::map<std::string, device_method> known{
        {"vsm_unorm16", {VSM_32, {format::eR16G16Unorm}, {float(variance_unorm16_minimum_variance)}}},
        {"evsm_half",
         {EVSM_64,
          {format::eR16G16B16A16Sfloat},
          {float(exponential_variance_half_exponent), float(exponential_variance_half_exponent),
           float(exponential_variance_half_minimum_variance)}}},
        {"evsm_float",
         {EVSM_128,
          {format::eR32G32B32A32Sfloat},
          {float(exponential_variance_float_positive_exponent), float(exponential_variance_float_negative_exponent),
           float(exponential_variance_float_minimum_variance)}}},
        {"msm4_unorm16", {MSM_64, {format::eR16G16B16A16Unorm}}},
        {"msm4_float", {MSM_128, {format::eR32G32B32A32Sfloat}}},
        {"msm6_unorm10", {MSM6_60, {format::eA2B10G10R10UnormPack32, format::eA2B10G10R10UnormPack32}}},
        {"msm6_unorm16", {MSM6_96, {format::eR16G16B16A16Unorm, format::eR16G16Unorm}}},
        {"msm6_float", {MSM6_192, {format::eR32G32B32A32Sfloat, format::eR32G32Sfloat}}}};
    return known.at(m.id);
}

} // namespace gnomon::evaluation
