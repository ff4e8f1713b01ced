// How each method of the demo that this example renders is stored and set on a device. Everything that belongs to a
// format comes from the library's type of it.
#pragma once

#include "evaluation/methods/methods.hpp"
#include "evaluation/vulkan/shaders/method_id.h"
#include "renderer.hpp"

#include <array>
#include <bit>
#include <tuple>

namespace gnomon::evaluation {

template <method M> extern const device_method on_device;

template <>
inline const device_method on_device<vsm_32>{
    VSM_32, {vk::Format::eR16G16Unorm}, {variance_unorm16::settings<float>().minimum_variance}};
template <>
inline const device_method on_device<evsm_64>{
    EVSM_64,
    {vk::Format::eR16G16B16A16Sfloat},
    std::bit_cast<std::array<float, 3>>(exponential_variance_half::settings<float>())};
template <>
inline const device_method on_device<evsm_128>{
    EVSM_128,
    {vk::Format::eR32G32B32A32Sfloat},
    std::bit_cast<std::array<float, 3>>(exponential_variance_float::settings<float>())};
template <> inline const device_method on_device<msm_64>{MSM_64, {vk::Format::eR16G16B16A16Unorm}};
template <> inline const device_method on_device<msm_128>{MSM_128, {vk::Format::eR32G32B32A32Sfloat}};
template <>
inline const device_method on_device<msm6_60>{
    MSM6_60, {vk::Format::eA2B10G10R10UnormPack32, vk::Format::eA2B10G10R10UnormPack32}};
template <>
inline const device_method on_device<msm6_96>{MSM6_96, {vk::Format::eR16G16B16A16Unorm, vk::Format::eR16G16Unorm}};
template <>
inline const device_method on_device<msm6_192>{MSM6_192, {vk::Format::eR32G32B32A32Sfloat, vk::Format::eR32G32Sfloat}};

// Calls each.template operator()<M>() for every one of them.
template <class Each> void for_each_device_method(Each each)
{
    [&]<method... M>(std::tuple<M...>*) { (each.template operator()<M>(), ...); }
    (static_cast<std::tuple<vsm_32, evsm_64, evsm_128, msm_64, msm_128, msm6_60, msm6_96, msm6_192>*>(nullptr));
}

} // namespace gnomon::evaluation
