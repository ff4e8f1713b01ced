// Colours of the stages: of surfaces, and of insets.
#pragma once

#include <glm/vec3.hpp>

namespace gnomon::renderer::paint {

inline const glm::vec3 clay(0.72f, 0.45f, 0.33f), sand(0.74f, 0.66f, 0.48f), moss(0.42f, 0.58f, 0.36f), stone(0.5f);
inline const glm::vec3 green(0.05f, 0.6f, 0.1f), cyan(0.02f, 0.6f, 0.7f), orange(0.95f, 0.35f, 0.02f); // of insets

} // namespace gnomon::renderer::paint
