// The shaders as glslangValidator compiled them, from either language.
#pragma once

#include "blur_glsl.h"
#include "blur_hlsl.h"
#include "lighting_glsl.h"
#include "lighting_hlsl.h"
#include "resolve_glsl.h"
#include "resolve_hlsl.h"
#include "scene_glsl.h"
#include "scene_hlsl.h"

#include <cstdint>
#include <span>

namespace gnomon::evaluation {

struct shader_texts {
    std::span<const std::uint32_t> scene, resolve, blur, lighting;
};

inline const shader_texts glsl{scene_glsl, resolve_glsl, blur_glsl, lighting_glsl};
inline const shader_texts hlsl{scene_hlsl, resolve_hlsl, blur_hlsl, lighting_hlsl};

} // namespace gnomon::evaluation
