// What methods beyond Peters et al. 2017 promise, on the driver's scenes: fusion of two occluders is nearer to the traced
// light, and receivers that least and greatest depths decide are those of percentage-closer soft shadows.
#include "evaluation/soft/soft_method.hpp"
#include "evaluation/soft/soft_scene.hpp"
#include "evaluation/soft/soft_stage.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const soft_method& method_of(std::string_view id)
{
    const std::vector<const soft_method*> all = registry_of<method>().all_of<soft_method>();
    const auto found = std::ranges::find_if(all, [id](const soft_method* m) { return m->id == id; });
    REQUIRE(found != all.end());
    return **found;
}

struct shadowed {
    std::vector<float> visibility;
    std::optional<skipped_shares> skipped;
    std::size_t bytes;
};

shadowed shadows(std::string_view id, const soft_stage& stage)
{
    const soft_method& m = method_of(id);
    const auto map = m.build(stage.depths(), stage.light(m.widest_search));
    shadowed r{std::vector<float>(stage.where.size()), map->skipped(stage.where), map->bytes()};
    map->intensities(stage.where, r.visibility);
    for (float& v : r.visibility) v = 1 - v;
    return r;
}

double rmse(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
    return std::sqrt(sum / double(a.size()));
}

} // namespace

TEST_CASE("methods beyond the paper keep what they promise in every scene")
{
    for (const soft_scene* scene : registry_of<scene_entry>().all_of<soft_scene>()) {
        CAPTURE(scene->id);
        const renderer::stage scenery = scene->stage(16. / 9);
        const soft_stage stage(scenery, {.width = 240, .height = 135, .map_resolution = 1024});
        const std::vector<float> traced = traced_visibility(stage, 64),
                                 filtered = filtered_visibility(stage, stage.where, 27);
        const shadowed usual = shadows("msm4_soft", stage);
        const double error = rmse(usual.visibility, traced);

        const double fused = rmse(shadows("msm4_soft_fused", stage).visibility, traced);
        MESSAGE(scene->id, ": one occluder ", error, ", two ", fused);
        CHECK(fused <= (scene->id == "pillar" ? 0.9 : 1.01) * error);

        // Least and greatest depths replace what a table says by what filtering says.
        const shadowed decided = shadows("msm4_soft_decided", stage);
        for (std::size_t i = 0; i < traced.size(); ++i)
            if (decided.visibility[i] != usual.visibility[i])
                REQUIRE(std::abs(decided.visibility[i] - filtered[i]) < 1e-6f);
        REQUIRE(decided.skipped);
        const auto dark = std::ranges::count_if(filtered, [](float v) { return v < 1e-6f; });
        CHECK(decided.skipped->umbra <= double(dark) / double(filtered.size()));
        CHECK(decided.skipped->umbra > (scene->id == "pillar" ? 0.5 : 0));
        CHECK(double(decided.bytes - usual.bytes) <= double(usual.bytes) / 16 / 6);

        CHECK(double(shadows("msm4_soft_mips", stage).bytes) < 0.67 * double(usual.bytes));
    }
}
