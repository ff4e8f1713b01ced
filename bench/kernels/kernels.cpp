// Every kernel of tests/support/kernels.txt on inputs of its domain, in L1: scalar code and the widest pack in turn, so
// that a new kernel has a time without further text. The other benches compare ways and baselines.
#define GNOMON_BENCH_ARITHMETIC exact
#include "kernels.hpp"

#include "core/measure.hpp"
#include "support/kernel_inputs.hpp"

namespace gnomon::bench {

constexpr std::size_t blocks = resident_fragments / test::block_rows;

template <class Lane, std::size_t numbers> using rows = std::array<Lane, resident_fragments * numbers>;

template <class Scalar, class Pack>
void time_kernel(benchmark::State& state, const char* name, const char* families, bool packed)
{
    alignas(64) static rows<float, Scalar::inputs> in;
    alignas(64) static rows<float, Scalar::outputs> out;
    test::kernel_inputs<float>(name, families, Scalar::inputs).draw(blocks, in.data(), test::row_kind::tame);
    const auto times = time_in_turn({{[] { Scalar::run(blocks, in.data(), out.data()); }, double(resident_fragments)},
                                     {[] { Pack::run(blocks, in.data(), out.data()); }, double(resident_fragments)}});
    for (auto _ : state) state.SetIterationTime(quantile(times[packed], 0.5) * 1e-9);
    if (packed) state.counters["speedup"] = median_ratio(times[0], times[1]);
}

template <class Scalar, class Pack> void add_rows(const std::string& name, const char* families)
{
    for (const bool packed : {false, true}) {
        const std::string way = packed ? std::to_string(xsimd::batch<float>::size) + " lanes" : "float";
        benchmark::RegisterBenchmark(
            ("kernels/" + name + '/' + way).c_str(),
            [=](benchmark::State& state) { time_kernel<Scalar, Pack>(state, name.c_str(), families, packed); })
            ->Iterations(1)
            ->UseManualTime()
            ->Unit(benchmark::kNanosecond);
    }
}

[[maybe_unused]] const bool registered = [] {
#define ADD(name, inputs, outputs, families, ...)            \
    add_rows<test::kernel_call<float, &gnomon::name<float>>, \
             test::kernel_call<xsimd::batch<float>, &gnomon::name<xsimd::batch<float>>>>(#name, families);
    GNOMON_FOR_EACH_KERNEL(ADD)
#undef ADD
    return true;
}();

} // namespace gnomon::bench
