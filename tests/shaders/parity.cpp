// Runs every kernel by some routes over the same rows of numbers and compares bit for bit with the host. Results that
// are in [0, 1] by contract are looked at for that as well, and for a NaN that is lit: a device with another division keeps both.
//
// NaN equals NaN: which of its patterns an operation gives is no language's promise. +0 and -0 differ.
#include "kernels.hpp"
#include "renderer/output/file.hpp"
#include "route.hpp"
#include "support/effort.hpp"
#include "support/kernel_inputs.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

using namespace gnomon;
using namespace gnomon::parity;

namespace {

constexpr int skipped = 77; // ctest's SKIP_RETURN_CODE

constexpr kernel kernels[] = {
#define SHAPE(name, inputs, outputs, families, unit) {#name, inputs, outputs, families, unit},
    GNOMON_FOR_EACH_KERNEL(SHAPE)};

/// Treatment of denormals by a processor: none, or they are zero where they go in or come out. A driver does
/// as it likes (only a probe tells), and the host that it is compared with then does the same.
struct denormals {
    bool in_flushed = false, out_flushed = false;
    auto operator<=>(const denormals&) const = default;
};

denormals probe(route& r)
{
    constexpr float least_normal = std::numeric_limits<float>::min();
    constexpr kernel two_difference{"two_difference", 2, 2, "", false};
    std::array<float, 2 * test::block_rows> in{}, out{};
    in[0] = least_normal / 2;
    in[1] = least_normal * 1.5f;
    in[test::block_rows + 1] = least_normal;
    r.run(two_difference, in, out);
    return {out[0] == 0, out[1] == 0};
}

/// While it lives, the host treats denormals so.
class denormals_as {
  public:
#if defined(__SSE__)
    explicit denormals_as(denormals d) : before_(_mm_getcsr())
    {
        _mm_setcsr(before_ | (d.in_flushed ? 0x0040u : 0u) | (d.out_flushed ? 0x8000u : 0u));
    }
    ~denormals_as() { _mm_setcsr(before_); }
    denormals_as(const denormals_as&) = delete;
    denormals_as& operator=(const denormals_as&) = delete;

  private:
    unsigned before_;
#else
    explicit denormals_as(denormals d)
    {
        if (d != denormals{}) throw unavailable("flushes denormals, which this host cannot be told to do");
    }
#endif
};

struct candidate {
    std::string name;
    std::unique_ptr<route> where;
    denormals flush;
};

/// The host's results for one kernel's rows, computed at their first use.
class references {
  public:
    references() : split_(module_route(built("host_split.so"))), fused_(module_route(built("host_scalar.so"))) {}

    [[nodiscard]] bool fuses() const { return fused_->computes() == products::fused; }

    void reset(const kernel& k, std::span<const float> in)
    {
        kernel_ = &k;
        in_ = in;
        results_.clear();
    }
    const std::vector<float>& of(products kind, denormals d)
    {
        const bool fused = kind == products::fused;
        for (const result& r : results_)
            if (r.fused == fused && r.flush == d) return r.out;
        result& r = results_.emplace_back(
            result{fused, d, std::vector<float>(in_.size() / kernel_->inputs * kernel_->outputs)});
        const denormals_as mode(d);
        (fused ? fused_ : split_)->run(*kernel_, in_, r.out);
        return r.out;
    }

  private:
    struct result {
        bool fused;
        denormals flush;
        std::vector<float> out;
    };
    std::unique_ptr<route> split_, fused_;
    const kernel* kernel_ = nullptr;
    std::span<const float> in_;
    std::vector<result> results_;
};

/// A value that is only moved keeps its bits, or does not: what flushes denormals may do so there, too, and takes a denormal
/// for zero.
float stored(float x, denormals d)
{
    return d.out_flushed && std::fpclassify(x) == FP_SUBNORMAL ? std::copysign(0.0f, x) : x;
}

/// Row i of blocks of n numbers each.
std::vector<float> row_of(std::span<const float> blocks, std::size_t n, std::size_t i)
{
    std::vector<float> row(n);
    for (std::size_t j = 0; j < n; ++j)
        row[j] = blocks[i / test::block_rows * test::block_rows * n + j * test::block_rows + i % test::block_rows];
    return row;
}

/// Operands whose products are the same fused and split: products of these, and of their products, stay
/// within the domain of two_product.
bool tame(const std::vector<float>& row)
{
    return std::all_of(row.begin(), row.end(),
                       [](float x) { return x == 0 || (std::abs(x) >= 0x1p-20f && std::abs(x) <= 0x1p20f); });
}

std::vector<std::string> hexadecimal(const std::vector<float>& row)
{
    std::vector<std::string> words;
    for (const float x : row) words.push_back(fmt::format("{:a}", x));
    return words;
}

/// One kernel by one route, as a row of the report.
nlohmann::ordered_json compare(const kernel& k, const candidate& c, const test::kernel_inputs<float>& inputs,
                               std::span<const float> in, references& hosts, bool keeps_nan)
{
    const std::size_t rows = in.size() / k.inputs;
    std::vector<float> got(rows * k.outputs);
    c.where->run(k, in, got);
    const std::vector<float>& want = hosts.of(c.where->computes(), c.flush);
    const bool only_tame = c.where->computes() == products::fused_against_split;
    std::size_t compared = 0, differing = 0, outside = 0;
    nlohmann::ordered_json first;
    for (std::size_t i = 0; i < rows; ++i) {
        if (only_tame && !tame(row_of(in, k.inputs, i))) continue;
        ++compared;
        const std::size_t at = i / test::block_rows * test::block_rows * k.outputs + i % test::block_rows;
        const std::vector<float> row = k.unit ? row_of(in, k.inputs, i) : std::vector<float>{};
        const bool has_nan = inputs.lacks_information(row);
        bool equal = true, within = true;
        for (std::size_t j = at; j < at + k.outputs * test::block_rows; j += test::block_rows) {
            const float host = stored(want[j], c.flush), x = stored(got[j], c.flush);
            equal = equal && test::same(host, x);
            within = within && x >= 0 && x <= 1 && !(keeps_nan && has_nan && host == 0 && x != 0);
        }
        outside += k.unit && !within;
        if (equal) continue;
        if (differing++ == 0)
            first = {{"row", i},
                     {"inputs", hexadecimal(row_of(in, k.inputs, i))},
                     {"host", hexadecimal(row_of(want, k.outputs, i))},
                     {"route", hexadecimal(row_of(got, k.outputs, i))}};
    }
    nlohmann::ordered_json row{{"kernel", k.name}, {"route", c.name},        {"device", c.where->device()},
                               {"rows", compared}, {"differing", differing}, {"outside", outside}};
    if (differing > 0) row["first"] = first;
    return row;
}

/// The routes that this machine can run; says why it cannot run others.
std::vector<candidate> prepare(const std::vector<named_route>& wanted, const references& hosts)
{
    std::vector<candidate> ready;
    for (const named_route& r : wanted) {
        try {
            candidate c{r.name, r.make(), {}};
            if (c.where->computes() == products::fused && !hosts.fuses())
                throw unavailable("no fused multiply-add on this processor to compare with");
            c.flush = probe(*c.where);
            ready.push_back(std::move(c));
        } catch (const unavailable& why) {
            fmt::print("parity: {} skipped: {}\n", r.name, why.what());
        }
    }
    return ready;
}

/// Totals and what differs, on stdout; true where nothing does.
bool summarize(const nlohmann::ordered_json& report, const std::vector<candidate>& candidates, bool bits)
{
    bool clean = true;
    for (const candidate& c : candidates) {
        std::size_t count = 0, rows = 0, differing = 0, outside = 0;
        for (const auto& row : report) {
            if (row["route"] != c.name) continue;
            ++count;
            rows += row["rows"].get<std::size_t>();
            if (const auto n = row["outside"].get<std::size_t>(); n > 0) {
                outside += n;
                fmt::print("{} by {}: {} rows outside of [0, 1], or a NaN that is not lit\n",
                           row["kernel"].get<std::string>(), c.name, n);
            }
            if (const auto n = row["differing"].get<std::size_t>(); n > 0) {
                differing += n;
                if (!bits) continue;
                fmt::print("{} by {}: {} of {} rows differ, first {}\n", row["kernel"].get<std::string>(), c.name, n,
                           row["rows"].get<std::size_t>(), row["first"].dump());
            }
        }
        const auto complaints = c.where->complaints();
        for (const std::string& complaint : complaints) fmt::print("{} complains: {}\n", c.name, complaint);
        fmt::print("{}: {} kernels, {} rows, {} differ, {} outside, {} complaints ({}{}{})\n", c.name, count, rows,
                   differing, outside, complaints.size(), c.where->device(),
                   c.flush.in_flushed ? ", denormals in are zero" : "",
                   c.flush.out_flushed ? ", denormals out are zero" : "");
        clean = clean && count > 0 && (differing == 0 || !bits) && outside == 0 && complaints.empty();
    }
    return clean;
}

} // namespace

int main(int argc, char** argv)
try {
    std::vector<std::string> routes, known, modules, names, all;
    for (const named_route& r : all_routes()) known.push_back(r.name);
    for (const kernel& k : kernels) all.emplace_back(k.name);
    std::int64_t rows = test::effort(std::int64_t{1} << 20);
    std::string out;
    bool list = false, contract = false, range = false;

    CLI::App app("Compares routes with the host, kernel by kernel and bit by bit.", "parity");
    app.add_flag("--list", list, "names every route");
    app.add_option("--route", routes, "routes to run; all unless told")->check(CLI::IsMember(known));
    app.add_option("--module", modules, "shared objects that export module.hpp, as routes")->check(CLI::ExistingFile);
    app.add_option("--kernel", names, "kernels to run; all unless told")->check(CLI::IsMember(all));
    app.add_option("--rows", rows, "rows for each kernel, a 16th for lists, rounded up to blocks of 64")
        ->check(CLI::Range(1, 1 << 26));
    app.add_flag("--contract", contract, "lets bits differ: only [0, 1], and NaN lit, count");
    app.add_flag("--range", range, "as --contract, where NaN may be lost: only [0, 1] counts");
    app.add_option("--out", out, "JSON with a row for each kernel and route");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        fmt::print(stderr, "parity: {}\n", error.what());
        return 2;
    }
    if (list) {
        for (const std::string& name : known) fmt::print("{}\n", name);
        return 0;
    }
    if (routes.empty() && modules.empty()) routes = known;
    if (names.empty()) names = all;
    std::vector<named_route> wanted;
    for (const named_route& r : all_routes())
        if (std::find(routes.begin(), routes.end(), r.name) != routes.end()) wanted.push_back(r);
    for (const std::string& file : modules) wanted.push_back({file, [file] { return module_route(file); }});

    references hosts;
    const std::vector<candidate> candidates = prepare(wanted, hosts);
    auto report = nlohmann::ordered_json::array();
    std::size_t done = 0;
    for (const kernel& k : kernels) {
        if (std::find(names.begin(), names.end(), k.name) == names.end() || candidates.empty()) continue;
        fmt::print(stderr, "parity: {} ({} of {})\n", k.name, ++done, names.size());
        // Lists are loops in loops: all rows of range_list_resolve would take SwiftShader six minutes.
        const bool is_list = std::string_view(k.name).find("_list_") != std::string_view::npos;
        const std::size_t rows_per_block = test::block_rows * (is_list ? 16 : 1);
        // At most 128 MiB, which is what Vulkan and WebGPU promise a buffer.
        const std::size_t most =
            (std::size_t{1} << 27) / (test::block_rows * std::max(k.inputs, k.outputs) * sizeof(float));
        const std::size_t count = std::min((std::size_t(rows) - 1) / rows_per_block + 1, most);
        std::vector<float> in(count * test::block_rows * k.inputs);
        test::kernel_inputs<float> inputs(k.name, k.families, k.inputs);
        inputs.draw(count, in.data());
        hosts.reset(k, in);
        for (const candidate& c : candidates) report.push_back(compare(k, c, inputs, in, hosts, !range));
    }
    if (!out.empty()) renderer::write_file(out, report.dump(1) + "\n");
    if (!summarize(report, candidates, !contract && !range)) return 1;
    if (candidates.size() == wanted.size()) return 0;
    const char* ci = std::getenv("CI");
    return ci != nullptr && std::string_view(ci) == "true" ? 1 : skipped;
} catch (const std::exception& error) {
    fmt::print(stderr, "parity: {}\n", error.what());
    return 2;
}
