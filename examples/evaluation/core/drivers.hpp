// The drivers of the demo. Each leaves pictures and a page of facts, FOLDER/NAME/facts.json, for the gallery, and rows
// in report.json.
#pragma once

#include "progress.hpp"

#include <array>
#include <filesystem>
#include <string_view>

namespace gnomon::evaluation {

struct settings {
    int width = 1280, height = 720;
    int supersampling = 1; // camera samples per pixel and axis
    int map_resolution = 1024;
    bool hlsl = false; // shaders from their HLSL text instead of the GLSL one
    std::filesystem::path out = "out";
};

// The scene of Peters et al. 2017, Figure 4, and a scene of contacts, left in FOLDER/contact, by every method.
void hard_shadows(const settings& how);

// A model from a file on a ground plane, by every method.
void model(const settings& how, const std::filesystem::path& file);

// The scene of hard_shadows by shaders on a Vulkan device, compared with the same methods on the CPU.
void vulkan_shadows(const settings& how);

// Bounds and representations of one depth distribution from 2, 4 and 6 moments, after the paper's Figure 2.
void bounds(const settings& how);

// The scenes of Palmer 2011, Hong & Oh and others in motion, by every kind of shadow map of ranges.
void motion_analytic(const settings& how);

// A model from a file on a ground plane, on its way from one time of an animation to another, both in seconds, by every
// kind of shadow map of ranges. An empty name means the file's first animation.
void animated_model(const settings& how, const std::filesystem::path& file, std::string_view animation,
                    const std::array<double, 2>& shutter);

} // namespace gnomon::evaluation
