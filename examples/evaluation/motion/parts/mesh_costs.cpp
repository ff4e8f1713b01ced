// The costs of maps of ranges of the meshes that people have: animated models and finely tessellated cloth, beside cubes.
// Models are those of Debian's assimp-testmodels; where they are absent a line of progress says so.
#include "evaluation/core/progress.hpp"
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/accumulation.hpp"
#include "evaluation/motion/maps/rasterized_ranges.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "renderer/import/model.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
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
constexpr int accumulated = 16;

// Rows of a mesh, one for each kind of map that the rasterizer makes in one go; times are of building and resolving
// together.
void add_costs(const moving_stage& stage, const std::string& name, int resolution, std::vector<table_row>& to)
{
    const double accumulation =
        least_seconds([&] { accumulate(stage.world, stage.light, resolution, middle_times(accumulated)); });
    for (const rasterized_ranges* one : registry_of<method>().all_of<rasterized_ranges>()) {
        range_rasterizer rasterize;
        const range_lists* lists = nullptr;
        const double spent =
            least_seconds([&] { lists = &rasterize(stage.world, stage.light, resolution, resolution, one->options); });
        const auto pairs = double(lists->counts.pairs);
        to.push_back({.cells = {{"mesh", name},
                                {"method", one->label},
                                {"triangles", double(triangle_numbers(stage.world.open).count())},
                                {"resolution", double(resolution)},
                                {"pairs", pairs},
                                {"ranges", double(lists->ranges.size())},
                                {"bytes", double(lists->bytes())},
                                {"build", 1e3 * spent},
                                {"ns", 1e9 * spent / pairs},
                                {"accumulation", 1e3 * accumulation}},
                      .colour = one->its_family().colour});
    }
}

std::vector<table_row> costs_of_meshes(const motion_sizes& size)
{
    const double aspect = double(size.width) / size.height;
    const bool full = size.map_resolution >= 1024;
    std::vector<table_row> result;
    add_costs(random_cubes(aspect, 400, 0.5f), "400 random cubes", size.map_resolution, result);
    // Full: a million triangles, each about as large as a texel.
    const int cells = full ? 708 : size.map_resolution / 4;
    const int resolution = full ? size.map_resolution : size.map_resolution / 2;
    add_costs(waving_sheet(aspect, cells), "waving sheet", resolution, result);
    const std::filesystem::path folder(GNOMON_TEST_MODELS);
    for (const animated_file& some : animated_files) {
        const std::filesystem::path file = folder / some.name;
        if (folder.empty() || !exists(file)) {
            progress("motion_analytic", "left out: animated models, since assimp-testmodels is not installed");
            break;
        }
        add_costs(animated_model_stage(load_animated_model(file, "", some.open, some.closing), aspect),
                  file.stem().string(), size.map_resolution, result);
    }
    return result;
}

block table_of_meshes(std::vector<table_row> rows)
{
    return table_block{
        .title = "Meshes that people have",
        .text =
            "The cost of building and resolving maps: of cubes, of a finely tessellated sheet whose triangles are as "
            "small as texels, and of animated models of Debian's assimp-testmodels, where that is installed. A pair is "
            "a "
            "triangle and a texel that it covers at some time.",
        .columns = {{.key = "mesh", .label = "mesh"},
                    {.key = "method", .label = "method"},
                    {.key = "triangles", .label = "triangles", .digits = 0},
                    {.key = "resolution", .label = "map, texels a side", .digits = 0},
                    {.key = "pairs", .label = "pairs", .digits = 0},
                    {.key = "ranges", .label = "ranges", .digits = 0},
                    {.key = "bytes", .label = "MiB", .digits = 1, .scale = 0x1p-20},
                    {.key = "build", .label = "map, ms", .digits = 1},
                    {.key = "ns", .label = "ns per pair", .digits = 1},
                    {.key = "accumulation", .label = fmt::format("{} shadow maps, ms", accumulated), .digits = 1}},
        .rows = std::move(rows)};
}

part_run mesh_costs(const motion_settings& how)
{
    const auto found = std::make_shared<std::vector<table_row>>();
    return {.tasks = {[=, size = how.size] { *found = costs_of_meshes(size); }},
            .results = [=] { return part_results{.blocks = {table_of_meshes(*found)}}; }};
}

const registered<motion_part> entry{
    motion_part{.id = "mesh_costs", .label = "costs of meshes", .order = 40, .begin = mesh_costs}};

} // namespace

} // namespace gnomon::evaluation
