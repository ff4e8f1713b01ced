// Every method of the registry that looks up a shadow map: the kernel alone on fetched values, one receiver at a time and
// by packs, and the time with the look-up beside it. Values are those of the fence scene. The baseline is Algorithm 1 of
// Peters et al. 2017 for four moments, one receiver at a time, as in the benches of kernels.
#include "core/measure.hpp"
#include "evaluation/core/method.hpp"
#include "renderer/scene/stage.hpp"

#include <gnomon/passes/blur.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::bench {

namespace {

using namespace evaluation;

constexpr const char* baseline = "msm4_float_paper";

struct fence {
    depth_map depths;
    std::vector<map_receiver> where;
    std::array<float, 9> taps = gaussian_weights();

    fence()
    {
        constexpr int width = 320, height = 180, resolution = 256;
        const renderer::stage scenery = renderer::fence_stage(double(width) / height);
        depths = renderer::rasterize_depth<4>(scenery.world, scenery.light, resolution, resolution);
        const auto seen = renderer::rasterize_surfaces(scenery.world, scenery.eye, width, height);
        const std::vector<map_receiver> all = map_receivers_of(seen, scenery.light, resolution).biased;
        const std::size_t count = std::min<std::size_t>(all.size(), resident_fragments);
        for (std::size_t i = 0; i < count; ++i) where.push_back(all[i * (all.size() / count)]);
    }
};

const fence& scene()
{
    static const fence result;
    return result;
}

struct looked_up_map {
    std::unique_ptr<shadow_map> map;
    std::vector<timed_look_up> times;
    std::vector<float> intensities = std::vector<float>(scene().where.size());

    explicit looked_up_map(const shadow_method& m)
        : map(m.build(scene().depths, scene().taps)), times(map->timed(scene().where))
    {}

    work of(const timed_run& timed)
    {
        return {[this, &timed] { timed.run(intensities); }, double(timed.receivers)};
    }
};

void add_method(const shadow_method& m)
{
    const auto row = [&m](std::size_t way) {
        return [&m, way](benchmark::State& state) {
            looked_up_map measured(m), other(dynamic_cast<const shadow_method&>(registry_of<method>().at(baseline)));
            const timed_look_up& t = measured.times[way];
            const auto times =
                time_in_turn({measured.of(t.kernel), measured.of(t.look_up), other.of(other.times.front().kernel)});
            for (auto _ : state) state.SetIterationTime(quantile(times[0], 0.5) * 1e-9);
            state.counters["least_ns"] = quantile(times[0], 0);
            state.counters["look_up_ns"] = quantile(times[1], 0.5);
            state.counters["speedup"] = median_ratio(times[2], times[0]);
        };
    };
    const std::vector<timed_look_up> ways = looked_up_map(m).times;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const std::string name =
            "methods/" + m.id +
            (ways[way].lanes == 1 ? "/scalar float" : '/' + std::to_string(ways[way].lanes) + " lanes");
        benchmark::RegisterBenchmark(name.c_str(), row(way))
            ->Iterations(1)
            ->UseManualTime()
            ->Unit(benchmark::kNanosecond);
    }
}

} // namespace

} // namespace gnomon::bench

int main(int argc, char** argv)
{
    for (const gnomon::evaluation::method* m : gnomon::evaluation::methods_in_order())
        if (const auto* one = dynamic_cast<const gnomon::evaluation::shadow_method*>(m))
            gnomon::bench::add_method(*one);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
}
