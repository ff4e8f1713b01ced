// Settings from the command line of the demo.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace gnomon::evaluation {

struct model_settings {
    std::filesystem::path file;
    std::string animation{};                   // an empty name means the file's first one
    std::array<double, 2> shutter{0, 1. / 24}; // seconds after the animation's start
};

struct settings {
    int width = 1280, height = 720;
    int supersampling = 1; // camera samples per pixel and axis
    int map_resolution = 1024;
    bool hlsl = false; // shaders from their HLSL text instead of the GLSL one
    std::filesystem::path out = "out";
    model_settings model{};

    std::filesystem::path folder(const std::string& driver) const { return out / "gallery" / driver; }
};

} // namespace gnomon::evaluation
