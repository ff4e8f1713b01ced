#include "mesh_costs.hpp"

#include "accumulation.hpp"
#include "evaluation/core/timing.hpp"
#include "range_maps.hpp"
#include "renderer/import/model.hpp"
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#ifndef GNOMON_TEST_MODELS
#define GNOMON_TEST_MODELS ""
#endif

namespace gnomon::evaluation {

using namespace renderer;

namespace {

// A model, and a part of its animation in which it moves, in seconds.
struct animated_file {
    std::string_view name;
    double open, closing;
};
constexpr double exposure = 1. / 24; // a frame of film
constexpr std::array animated_files{animated_file{"X/Testwuson.X", 0, exposure},
                                    animated_file{"X/BCN_Epileptic.X", 0.5, 0.5 + exposure}};

struct kind {
    std::string_view method;
    range_options how;
};
constexpr std::array kinds{
    kind{"exact ranges", {.depth_tolerance = depth_tolerance}},
    kind{"resolved ranges", {.resolved = true, .depth_tolerance = depth_tolerance}},
    kind{"resolved ranges, joined", {.resolved = true, .depth_tolerance = depth_tolerance, .joining = depth_tolerance}},
    kind{"caster ranges", {.resolved = true, .backdrops = false, .depth_tolerance = depth_tolerance}}};

nlohmann::json costs_of(const moving_stage& stage, const std::string& name, int resolution)
{
    nlohmann::json row = {{"scene", name},
                          {"resolution", resolution},
                          {"triangles", triangle_numbers(stage.world.open).count()},
                          {"maps", nlohmann::json::array()}};
    for (const kind& k : kinds) {
        range_rasterizer rasterize;
        const range_lists* lists = nullptr;
        const double spent =
            least_seconds([&] { lists = &rasterize(stage.world, stage.light, resolution, resolution, k.how); });
        row["pairs"] = lists->counts.pairs, row["tested"] = lists->counts.tested;
        row["maps"].push_back({{"method", k.method},
                               {"ranges", lists->ranges.size()},
                               {"bytes", lists->bytes()},
                               {"build_ms", 1e3 * spent},
                               {"ns_per_pair", 1e9 * spent / double(lists->counts.pairs)}});
    }
    row["accumulation_ms"] =
        1e3 * least_seconds([&] { accumulate(stage.world, stage.light, resolution, middle_times(16)); });
    return row;
}

} // namespace

nlohmann::json mesh_costs(const motion_sizes& size)
{
    const double aspect = double(size.width) / size.height;
    const bool full = size.map_resolution >= 1024;
    nlohmann::json result = nlohmann::json::array();
    result.push_back(costs_of(random_cubes(aspect, 400, 0.5f), "400 random cubes", size.map_resolution));
    // Full: a million triangles, each about as large as a texel.
    const int cells = full ? 708 : size.map_resolution / 4;
    const int resolution = full ? size.map_resolution : size.map_resolution / 2;
    result.push_back(costs_of(waving_sheet(aspect, cells), "waving sheet", resolution));
    const std::filesystem::path folder(GNOMON_TEST_MODELS);
    for (const animated_file& some : animated_files) {
        const std::filesystem::path file = folder / some.name;
        if (folder.empty() || !exists(file)) {
            progress("motion_analytic", "left out: animated models, since assimp-testmodels is not installed");
            break;
        }
        result.push_back(costs_of(animated_model_stage(load_animated_model(file, "", some.open, some.closing), aspect),
                                  file.stem().string(), size.map_resolution));
    }
    return result;
}

} // namespace gnomon::evaluation
