// out/report.json: the rows' form, which rows a second run replaces, and what is refused.
#include "evaluation/core/report.hpp"

#include "renderer/folder.hpp"
#include "renderer/output/file.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon::evaluation;
using gnomon::renderer::read_file;
using gnomon::renderer::write_file;

namespace {

report_row some_row()
{
    return {.scene = "fence",
            .part = "wall",
            .method = "msm",
            .family = "moments",
            .map = "filtered",
            .receiver = "biased",
            .format = "unorm16",
            .parameters = {{"taps", 9}, {"exponent", 5.5}},
            .label = "MSM 64 bit",
            .reference = "filtered",
            .receivers = 10,
            .bytes_per_texel = 8,
            .map_bytes = 88,
            .errors = {.rmse = 0.5,
                       .mean_abs = 0.25,
                       .leak = 0.125,
                       .acne = 0.0625,
                       .max_abs = 1,
                       .max_dark = 0.75,
                       .darkened = 0.03125},
            .acne_unbiased = 0.015625,
            .ns_kernel = 1.5,
            .ns_per_receiver = 3.5,
            .build_ms = 2};
}

nlohmann::json parsed(const std::filesystem::path& file) { return nlohmann::json::parse(read_file(file)); }

} // namespace

TEST_CASE("statistics of errors with known sums")
{
    const std::vector<float> reference{0, 0, 1, 0.5f}, estimate{0.5f, 0, 0.25f, 0.5f};
    const error_statistics e = compare(estimate, reference);
    CHECK(e.leak == 0.125);
    CHECK(e.acne == 0.1875);
    CHECK(e.mean_abs == 0.3125);
    CHECK(e.max_abs == 0.75);
    CHECK(e.max_dark == 0.75);
    CHECK(e.darkened == 0.5);
    CHECK(e.rmse == std::sqrt((0.25 + 0.5625) / 4));
    CHECK(compare(std::vector<float>{0.25f}, std::vector<float>{0.375f}).darkened == 0); // nothing is lit
    CHECK_THROWS_WITH(compare(estimate, std::vector<float>(3)), "compare: 4 estimates, 3 references");
    CHECK_THROWS(compare({}, {}));
}

TEST_CASE("a row has the fields of the report, in their order")
{
    const temporary_folder folder;
    merge_report(folder / "report.json", std::vector{some_row()});
    const auto report = nlohmann::ordered_json::parse(read_file(folder / "report.json"));
    CHECK(report == nlohmann::ordered_json::parse(R"([{"scene": "fence", "part": "wall", "method": "msm",
        "family": "moments", "map": "filtered", "receiver": "biased", "format": "unorm16",
        "parameters": {"exponent": 5.5, "taps": 9.0}, "label": "MSM 64 bit", "reference": "filtered",
        "receivers": 10, "bytes_per_texel": 8.0, "map_bytes": 88.0, "rmse": 0.5, "mean_abs": 0.25, "leak": 0.125,
        "acne": 0.0625, "max_abs": 1.0, "max_dark": 0.75, "darkened": 0.03125, "acne_unbiased": 0.015625,
        "ns_kernel": 1.5, "ns_per_receiver": 3.5, "build_ms": 2.0, "real": "float", "lanes": 1, "threads": 1,
        "device": "cpu", "seeds": 1}])"));
}

TEST_CASE("a device's row has its name and the times of its passes, and replaces no other device's")
{
    const temporary_folder folder;
    report_row row = some_row();
    merge_report(folder / "report.json", std::vector{row});
    row.device = "some card";
    row.passes = {{"blur", 0.5}, {"lighting", 0.25}};
    merge_report(folder / "report.json", std::vector{row});
    row.passes[0].second = 0.75;
    merge_report(folder / "report.json", std::vector{row});
    const nlohmann::json report = parsed(folder / "report.json");
    REQUIRE(report.size() == 2);
    CHECK(report[0]["device"] == "cpu");
    CHECK(report[1]["device"] == "some card");
    CHECK(report[1]["blur_ms"] == 0.75);
    CHECK(report[1]["lighting_ms"] == 0.25);
}

TEST_CASE("a second run replaces its own rows only")
{
    const temporary_folder folder;
    const auto file = folder / "report.json";
    const std::vector<void (*)(report_row&)> changes{[](report_row&) {},
                                                     [](report_row& r) { r.scene = "model"; },
                                                     [](report_row& r) { r.part = "sign"; },
                                                     [](report_row& r) { r.method = "evsm"; },
                                                     [](report_row& r) { r.family = "exponential"; },
                                                     [](report_row& r) { r.map = "depths"; },
                                                     [](report_row& r) { r.receiver = "unbiased"; },
                                                     [](report_row& r) { r.format = "float32"; },
                                                     [](report_row& r) { r.parameters["taps"] = 5; },
                                                     [](report_row& r) { r.parameters.erase("taps"); },
                                                     [](report_row& r) { r.reference = "traced"; },
                                                     [](report_row& r) { r.real = "double"; },
                                                     [](report_row& r) { r.lanes = 8; },
                                                     [](report_row& r) { r.threads = 2; },
                                                     [](report_row& r) { r.device = "some card"; }};
    std::vector<report_row> rows(changes.size(), some_row());
    for (std::size_t i = 0; i < rows.size(); ++i) changes[i](rows[i]);
    merge_report(file, rows);
    CHECK(parsed(file).size() == rows.size());
    for (report_row& row : rows) {
        row.receivers = 99;
        row.label = "in other words";
        const auto before = parsed(file);
        merge_report(file, {&row, 1});
        const auto after = parsed(file);
        REQUIRE(after.size() == before.size());
        int changed = 0;
        for (std::size_t i = 0; i < after.size(); ++i) changed += after[i] != before[i];
        CHECK(changed == 1);
    }
}

TEST_CASE("somebody else's file and numbers that JSON lacks are refused, and the file stays")
{
    const temporary_folder folder;
    const auto file = folder / "report.json";
    for (const char* content : {"not json", "{}", "[1]", "", "[{\"scene\": }]"}) {
        write_file(file, content);
        CHECK_THROWS_WITH(merge_report(file, std::vector{some_row()}),
                          (file.string() + ": not an array of report rows").c_str());
        CHECK(read_file(file) == content);
    }
    write_file(file, "[]");
    report_row row = some_row();
    row.errors.leak = std::nan("");
    CHECK_THROWS_WITH(merge_report(file, std::vector{row}),
                      (file.string() + ": leak of msm in fence is not finite").c_str());
    row = some_row();
    row.parameters["taps"] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(merge_report(file, std::vector{row}),
                      (file.string() + ": parameters.taps of msm in fence is not finite").c_str());
    CHECK(read_file(file) == "[]");
    write_file(file, R"([{"note": "a row of another program"}])");
    merge_report(file, std::vector{some_row()});
    CHECK(parsed(file).size() == 2);
}
