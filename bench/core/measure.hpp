// A row of a bench: a kernel that runs over many fragments in one way (scalar, plain loop, pack), beside the floor of
// the machine for its operations and a baseline kernel. All three are timed in turn, some 100 times, so that ratios
// compare times of the same milliseconds. Results are medians, since machines are shared.
#pragma once

#include "floor.hpp"

#include <gnomon/simd/wide.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::bench {

// A kernel is in the namespace of its compilation, exact or contracted, so that the linker keeps both.
#define GNOMON_BENCH_STRING_OF(name) #name
#define GNOMON_BENCH_STRING(name) GNOMON_BENCH_STRING_OF(name)

namespace GNOMON_BENCH_ARITHMETIC {
struct compilation {
    static constexpr auto arithmetic = GNOMON_BENCH_STRING(GNOMON_BENCH_ARITHMETIC);
};
} // namespace GNOMON_BENCH_ARITHMETIC

template <class Lane> using column = std::vector<Lane, xsimd::aligned_allocator<Lane, 64>>;

/// The operands and results of a kernel, one array for each.
template <class Lane, std::size_t inputs> struct fragments {
    std::array<column<Lane>, inputs> in;
    column<Lane> out;
};

inline constexpr std::size_t resident_fragments = 1024; // 32 KiB with seven operands and a result in float
inline constexpr std::size_t streamed_fragments = std::size_t{1} << 24; // 0.4 to 0.5 GiB: more than any cache
inline constexpr std::size_t streamed_window = std::size_t{1} << 14;

/// The fragments of a kernel, with operands from Kernel::samples.
template <class Kernel, class Lane> fragments<Lane, Kernel::inputs> make_fragments(std::size_t count)
{
    const auto samples = Kernel::samples(resident_fragments, 1);
    fragments<Lane, Kernel::inputs> f;
    for (std::size_t k = 0; k < Kernel::inputs; ++k) {
        f.in[k].resize(count);
        for (std::size_t i = 0; i < count; ++i) f.in[k][i] = static_cast<Lane>(samples[i % resident_fragments][k]);
    }
    f.out.resize(count);
    return f;
}

template <class Kernel> inline constexpr bool is_contracted = std::string_view(Kernel::arithmetic) == "contracted";

template <class Real> inline constexpr std::size_t lanes_of = sizeof(Real) / sizeof(lane_t<Real>);

template <class Real> inline constexpr bool is_wide = requires(Real x) { x.low; };

template <class Real> GNOMON_INLINE Real load(const lane_t<Real>* from)
{
    if constexpr (std::is_floating_point_v<Real>) return *from;
    else if constexpr (is_wide<Real>)
        return {decltype(Real::low)::load_aligned(from), decltype(Real::low)::load_aligned(from + lanes_of<Real> / 2)};
    else return Real::load_aligned(from);
}

template <class Real> GNOMON_INLINE void store(Real x, lane_t<Real>* to)
{
    if constexpr (std::is_floating_point_v<Real>) *to = x;
    else if constexpr (is_wide<Real>) x.low.store_aligned(to), x.high.store_aligned(to + lanes_of<Real> / 2);
    else x.store_aligned(to);
}

/// Runs the kernel for one fragment, or one pack of fragments, after the other.
template <class Kernel, class Real>
[[gnu::noinline]] void run_packs(fragments<lane_t<Real>, Kernel::inputs>& f, std::size_t begin, std::size_t end)
{
    [&]<std::size_t... k>(std::index_sequence<k...>) GNOMON_BENCH_INLINE
    {
        const std::array in{f.in[k].data()...};
        lane_t<Real>* const out = f.out.data();
        for (std::size_t i = begin; i < end; i += lanes_of<Real>) {
            Real result = Kernel::run(load<Real>(in[k] + i)...);
            forget(result);
            store(result, out + i);
        }
    }
    (std::make_index_sequence<Kernel::inputs>());
}

/// Runs the kernel in a plain loop, which the compiler may vectorise.
template <class Kernel, class Real>
[[gnu::noinline]] void run_plain_loop(fragments<Real, Kernel::inputs>& f, std::size_t begin, std::size_t end)
{
    [&]<std::size_t... k>(std::index_sequence<k...>) GNOMON_BENCH_INLINE
    {
        const std::array in{f.in[k].data()...};
        Real* const out = f.out.data();
#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#endif
        for (std::size_t i = begin; i < end; ++i) out[i] = Kernel::run(in[k][i]...);
    }
    (std::make_index_sequence<Kernel::inputs>());
}

/// The bytes of a function's machine code, from the symbol table.
inline double code_bytes(const void* function)
{
    Dl_info info;
    void* symbol = nullptr;
    const bool found = dladdr1(function, &info, &symbol, RTLD_DL_SYMENT) != 0 && symbol != nullptr;
    return found ? static_cast<double>(static_cast<const ElfW(Sym)*>(symbol)->st_size) : std::nan("");
}

/// A piece of work to time: run() processes `covered` fragments.
struct work {
    std::function<void()> run;
    double covered;
    int repeats = 1;

    double nanoseconds() const
    {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < repeats; ++i) run();
        const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
        return spent.count() / (covered * repeats);
    }
    /// Sets the repeats so that one timing lasts 30 microseconds, a thousand times as long as reading the clock.
    void calibrate()
    {
        while (nanoseconds() * covered * repeats < 3e4) repeats *= 2;
    }
};

inline double quantile(std::vector<double> values, double q)
{
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

inline constexpr int rounds = 101;

/// The nanoseconds per fragment of several works, timed in turn, as [work][round].
inline std::vector<std::vector<double>> time_in_turn(std::vector<work> works)
{
    for (work& w : works) w.calibrate();
    std::vector<std::vector<double>> times(works.size());
    for (int i = 0; i < rounds; ++i)
        for (std::size_t k = 0; k < works.size(); ++k) times[k].push_back(works[k].nanoseconds());
    return times;
}

inline double median_ratio(const std::vector<double>& over, const std::vector<double>& under)
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < over.size(); ++i) ratios.push_back(over[i] / under[i]);
    return quantile(ratios, 0.5);
}

/// Registers a row of two works, which are made when the row runs: the time of the first, and its speed relative to the
/// second. Returns true.
template <class Measured, class Baseline> bool add_comparison(const char* name, Measured measured, Baseline baseline)
{
    const auto run = [=](benchmark::State& state) {
        const auto times = time_in_turn({measured(), baseline()});
        for (auto _ : state) state.SetIterationTime(quantile(times[0], 0.5) * 1e-9);
        state.counters["least_ns"] = quantile(times[0], 0);
        state.counters["speedup"] = median_ratio(times[1], times[0]);
    };
    benchmark::RegisterBenchmark(name, run)->Iterations(1)->UseManualTime()->Unit(benchmark::kNanosecond);
    return true;
}

template <class Lane, std::size_t inputs>
using pass = void (*)(fragments<Lane, inputs>& f, std::size_t begin, std::size_t end);

/// The work of a pass over f: over all of a small f, else over the next window, none of which is in a cache.
template <class Lane, std::size_t inputs> work work_of(pass<Lane, inputs> run, fragments<Lane, inputs>& f)
{
    const std::size_t count = f.out.size(), step = std::min(count, streamed_window);
    std::size_t begin = 0;
    return {[=, &f]() mutable {
                run(f, begin, begin + step);
                begin = (begin + step) % count;
            },
            static_cast<double>(step)};
}

template <class Kernel, class Real> work floor_work()
{
    return {[] { run_floor<Kernel, Real>(resident_fragments / lanes_of<Real>); }, resident_fragments};
}

/// Reports the difference of float from double for the same float operands, over samples other than those
/// of the timing.
template <class Kernel> void report_errors(benchmark::State& state)
{
    if constexpr (requires { Kernel::has_error; }) {
        std::vector<double> errors;
        for (const auto& sample : Kernel::samples(65536, 2)) [&]<std::size_t... k>(std::index_sequence<k...>)
            {
                const std::array rounded{static_cast<float>(sample[k])...};
                errors.push_back(std::abs(static_cast<double>(Kernel::run(rounded[k]...)) -
                                          Kernel::run(static_cast<double>(rounded[k])...)));
            }
        (std::make_index_sequence<Kernel::inputs>());
        state.counters["error_p99"] = quantile(errors, 0.99);
        state.counters["error_p999"] = quantile(errors, 0.999);
    }
}

/// A row with its counters, which bench/run.py prints as columns.
template <class Kernel, class Baseline, class Real> struct row {
    using lane = lane_t<Real>;
    pass<lane, Kernel::inputs> run;
    bool streamed;

    void operator()(benchmark::State& state) const
    {
        const std::size_t count = streamed ? streamed_fragments : resident_fragments;
        auto f = make_fragments<Kernel, lane>(count);
        auto g = make_fragments<Baseline, lane>(count);
        constexpr operations n = operations_of<Kernel>;
        const auto times = time_in_turn({work_of(run, f), floor_work<Kernel, Real>(),
                                         work_of<lane, Baseline::inputs>(run_packs<Baseline, lane>, g)});
        for (auto _ : state) state.SetIterationTime(quantile(times[0], 0.5) * 1e-9);
        state.counters["least_ns"] = quantile(times[0], 0);
        state.counters["floor_ns"] = quantile(times[1], 0.5);
        state.counters["over_floor"] = median_ratio(times[0], times[1]);
        state.counters["speedup"] = median_ratio(times[2], times[0]);
        state.counters["code_bytes"] = code_bytes(reinterpret_cast<const void*>(run));
        state.counters["additions"] = n.additions;
        state.counters["multiplications"] = n.multiplications;
        state.counters["fused"] = n.fused;
        state.counters["divisions"] = n.divisions;
        state.counters["roots"] = n.roots;
        state.counters["other"] = n.comparisons + n.selections + n.extrema + n.signs;
        if (std::is_same_v<Real, float> && !streamed) report_errors<Kernel>(state);
    }
};

/// Times the floor alone.
template <class Kernel, class Real> void time_floor(benchmark::State& state)
{
    const auto times = time_in_turn({floor_work<Kernel, Real>()});
    for (auto _ : state) state.SetIterationTime(quantile(times[0], 0.5) * 1e-9);
}

/// Registers family/kernel/way/L1/arithmetic, and for exact arithmetic also family/kernel/way/floor/arithmetic and, for
/// kernels of few operands, family/kernel/way/memory/arithmetic.
template <class Kernel, class Baseline, class Real>
void add_row(const std::string& family, const std::string& way, pass<lane_t<Real>, Kernel::inputs> run)
{
    const auto add = [&](const std::string& where, auto function) {
        const std::string name = family + '/' + Kernel::name + '/' + way + '/' + where + '/' + Kernel::arithmetic;
        benchmark::RegisterBenchmark(name.c_str(), function)
            ->Iterations(1)
            ->UseManualTime()
            ->Unit(benchmark::kNanosecond);
    };
    add("L1", row<Kernel, Baseline, Real>{run, false});
    if (is_contracted<Kernel>) return;
    add("floor", time_floor<Kernel, Real>);
    // More operands need gigabytes, and two packs wait for memory as long as one.
    if (std::is_same_v<lane_t<Real>, float> && Kernel::inputs <= 10 && !is_wide<Real>)
        add("memory", row<Kernel, Baseline, Real>{run, true});
}

/// Registers rows for a pack, and for two packs as one (simd/wide.hpp).
template <class Kernel, class Baseline, class Pack> void add_pack_rows(const std::string& family)
{
    const std::string lanes = std::to_string(Pack::size) + " lanes";
    add_row<Kernel, Baseline, Pack>(family, lanes, run_packs<Kernel, Pack>);
    if constexpr (!is_contracted<Kernel>)
        add_row<Kernel, Baseline, wide<Pack>>(family, "2 x " + lanes, run_packs<Kernel, wide<Pack>>);
}

/// Registers a kernel in every way that this machine has. The baseline is timed in scalar code of the same lane type.
template <class Kernel, class Baseline> void add_rows(const std::string& family)
{
    add_row<Kernel, Baseline, float>(family, "scalar float", run_packs<Kernel, float>);
    if constexpr (!is_contracted<Kernel>) {
        add_row<Kernel, Baseline, double>(family, "scalar double", run_packs<Kernel, double>);
        add_row<Kernel, Baseline, float>(family, "plain loop", run_plain_loop<Kernel, float>);
    }
#if defined(__AVX2__)
    add_pack_rows<Kernel, Baseline, xsimd::batch<float, xsimd::avx2>>(family);
#else
    add_pack_rows<Kernel, Baseline, xsimd::batch<float>>(family);
#endif
#if defined(__AVX512BW__)
    add_pack_rows<Kernel, Baseline, xsimd::batch<float, xsimd::avx512bw>>(family);
#endif
}

/// Registers kernels in the given order. Returns true, so that the initialisation of a constant can call it.
template <class Baseline, class... Kernels> bool add_kernels(const std::string& family)
{
    (add_rows<Kernels, Baseline>(family), ...);
    return true;
}

} // namespace gnomon::bench
