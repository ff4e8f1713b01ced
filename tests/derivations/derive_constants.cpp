// Derives the constants of moments/quantization.h and moments/bias.h and prints them with their quality.
//   derive_constants [--json FILE]
#include "constants.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace {

using namespace gnomon::derivation;
using nlohmann::ordered_json;

std::string digits(double x) { return fmt::format("{:.17g}", x); }

/// x, or 0 if x is only the rounding error of a matrix of 20 to 50 digits.
double tidied(double x) { return std::abs(x) < 1e-20 ? 0 : x; }

template <typename Table> ordered_json rows(const Table& matrix)
{
    ordered_json result = ordered_json::array();
    for (int i = 0; i < matrix.rows(); ++i) {
        ordered_json row = ordered_json::array();
        for (int j = 0; j < matrix.cols(); ++j) row.push_back(tidied(static_cast<double>(matrix(i, j))));
        result.push_back(std::move(row));
    }
    return result;
}

void print_rows(const char* title, const ordered_json& matrix)
{
    fmt::print("  {}\n", title);
    for (const ordered_json& row : matrix) {
        fmt::print("   ");
        for (const ordered_json& x : row) fmt::print(" {:>24}", digits(x));
        fmt::print("\n");
    }
}

/// The highest of many climbs from random rows, compared with the given fixed point.
ordered_json search(const affine_transform<decimal50>& found)
{
    constexpr int starts = 20;
    const search_result result = random_climbs(found.exponents, starts, 1);
    return {{"stationarity", stationarity(found)},
            {"random_starts", starts},
            {"starts_that_reach_the_best", result.hits},
            {"best_over_this", result.determinant / static_cast<double>(found.determinant())}};
}

ordered_json transform_report(const char* name, const affine_transform<decimal50>& exact,
                              const affine_transform<decimal50>& printed)
{
    const ordered_json report = {{"name", name},
                                 {"matrix", rows(exact.matrix)},
                                 {"offset", rows(exact.offset.transpose())[0]},
                                 {"inverse", rows(exact.matrix.inverse().eval())},
                                 {"inverse_residual", inverse_residual(exact)},
                                 {"range_violation", range_violation(rounded(exact))},
                                 {"printed_range_violation", range_violation(printed)},
                                 {"entropy_gain_bits", entropy_gain(exact)},
                                 {"printed_entropy_gain_bits", entropy_gain(printed)}};
    fmt::print(
        "{}: {:.6f} bits over naive storage (as printed {:.6f}); leaves [0, 1] by {:.1e} (as printed {:.1e}); "
        "inverse to {:.1e}\n",
        name, entropy_gain(exact), entropy_gain(printed), range_violation(rounded(exact)), range_violation(printed),
        inverse_residual(exact));
    print_rows("matrix", report["matrix"]);
    print_rows("offset", ordered_json::array({report["offset"]}));
    print_rows("inverse; its transpose maps coefficients of a polynomial to the gradient by the stored channels",
               report["inverse"]);
    return report;
}

ordered_json bias_report(const bias_vector_set& vectors)
{
    ordered_json report = {{"stored", vectors.stored}};
    const auto add = [&](const char* key, const char* title, const bias_vector& b) {
        report[key] = {{"moments", rows(b.moments.transpose())[0]},
                       {"maximum_norm_distance", b.maximum_norm},
                       {"euclidean_distance", b.euclidean}};
        fmt::print("  {:8} {:22} {:.12f} {:.12f} ", vectors.stored, title, b.maximum_norm, b.euclidean);
        for (int i = 1; i < b.moments.size(); i += 2) fmt::print(" {}", digits(b.moments[i]));
        fmt::print("\n");
    };
    add("printed", "printed", vectors.printed);
    add("farthest_euclidean", "farthest, Euclidean", vectors.farthest_euclidean);
    add("farthest", "farthest, maximum norm", vectors.farthest);
    return report;
}

ordered_json derive()
{
    ordered_json report;
    const double determinant = static_cast<double>(signed_depth(4).determinant());
    fmt::print("[0, 1] to signed depth, m = 4: determinant {}, {} bits\n\n", determinant, std::log2(determinant));
    report["signed_depth_determinant"] = determinant;

    fmt::print(stderr, "transforms\n");
    const auto odd = odd6();
    const auto theta4 = join(odd4(), even4());
    report["transforms"] = {transform_report("Theta4*", theta4, theta4),
                            transform_report("Theta6*", join(odd, even6()), join(printed_odd6(), printed_even6()))};

    fmt::print(stderr, "search from random starts\n");
    report["search"] = {{"Theta4*, odd", search(odd4())},
                        {"Theta4*, even", search(even4())},
                        {"Theta6*, odd", search(odd)},
                        {"Theta6*, even", search(even6())}};
    fmt::print("\n{:16} {:>12} {:>24} {:>18}\n", "optimum", "row gain", "best of random / this", "reached");
    for (const auto& [name, row] : report["search"].items())
        fmt::print("{:16} {:12.1e} {:24.15f} {:>15}/{}\n", name, row["stationarity"].get<double>(),
                   row["best_over_this"].get<double>(), row["starts_that_reach_the_best"].get<int>(),
                   row["random_starts"].get<int>());
    const search_result dense = random_climbs(theta4.exponents, 40, 1);
    const double dense_gain = entropy_gain(theta4.exponents, dense.determinant);
    report["dense4_entropy_gain_bits"] = dense_gain;
    fmt::print("dense transform, m = 4: {:.4f} bits, reached from {} of 40 starts\n\n", dense_gain, dense.hits);

    fmt::print(stderr, "bias vectors\n");
    fmt::print("  {:8} {:22} {:14} {:14}  even moments\n", "stored", "bias vector", "maximum norm", "Euclidean");
    const auto vectors = bias_vectors();
    for (const bias_vector_set& v : vectors) report["bias"].push_back(bias_report(v));

    fmt::print("\n{:30} {:>12} {:>16} {:>16} {:>9}\n", "bias weights, rounding / r", "rounding", "printed vector",
               "farthest", "paper");
    for (const storage_format& f : formats(vectors)) {
        report["formats"].push_back({{"name", f.name},
                                     {"rounding", f.rounding},
                                     {"distance", f.distance},
                                     {"weight_printed", f.rounding / f.distance_printed},
                                     {"weight", f.weight()},
                                     {"paper_weight", f.paper_weight}});
        fmt::print("{:30} {:12.3e} {:16.4e} {:16.4e} {:>9}\n", f.name, f.rounding, f.rounding / f.distance_printed,
                   f.weight(), f.paper_weight > 0 ? fmt::format("{:.0e}", f.paper_weight) : "");
    }
    return report;
}

/// Writes the report to another file and renames it, so that an error leaves an earlier report untouched.
void write(const ordered_json& report, const std::string& path)
{
    const std::string aside = path + ".new";
    std::ofstream file(aside);
    file << report.dump(2) << '\n';
    file.close();
    if (!file) throw std::runtime_error("cannot write " + aside);
    std::filesystem::rename(aside, path);
}

} // namespace

int main(int argc, char** argv)
try {
    CLI::App app("Derives the quantization transforms, the bias vectors and the bias weights.");
    std::string json;
    app.add_option("--json", json, "also write the results to this file");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", app.help());
        return 0;
    }
    const ordered_json report = derive();
    if (!json.empty()) write(report, json);
} catch (const std::exception& error) {
    fmt::print(stderr, "derive_constants: {}\n", error.what());
    return 2;
}
