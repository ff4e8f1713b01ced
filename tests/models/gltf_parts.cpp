// Prints where the reader of glTF places every corner, before the model is normalised, as JSON:
//   gltf_parts FILE [ANIMATION OPEN CLOSING]
// Ends in one line and exit code 2 where the model cannot be loaded.
#include "renderer/import/gltf_model.hpp"
#include "renderer/import/model.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>

using namespace gnomon::renderer;

namespace {

nlohmann::json list(const std::vector<glm::dvec3>& places)
{
    nlohmann::json result = nlohmann::json::array();
    for (const glm::dvec3& place : places) result.push_back({place.x, place.y, place.z});
    return result;
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc != 2 && argc != 5) return 3;
    std::optional<exposure> when;
    if (argc == 5) when = exposure{argv[2], std::strtod(argv[3], nullptr), std::strtod(argv[4], nullptr)};
    if (when) load_animated_model(argv[1], when->animation, when->open, when->closing);
    else load_model(argv[1]);
    nlohmann::json parts = nlohmann::json::array();
    for (const model_part& part : read_gltf_parts(argv[1], when)) {
        nlohmann::json triangles = nlohmann::json::array();
        for (const glm::uvec3& t : part.triangles) triangles.push_back({t.x, t.y, t.z});
        parts.push_back({{"open", list(part.open)}, {"closing", list(part.closing)}, {"triangles", triangles}});
    }
    fmt::print("{}\n", parts.dump());
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
}
