#include "report.hpp"

#include "renderer/output/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::renderer {

namespace {

using json = nlohmann::ordered_json;

json to_json(const report_row& row)
{
    json result{{"scene", row.scene},
                {"method", row.method},
                {"format", row.format},
                {"reference", row.reference},
                {"receivers", row.receivers},
                {"bytes_per_texel", row.bytes_per_texel},
                {"rmse", row.errors.rmse},
                {"mean_abs", row.errors.mean_abs},
                {"leak", row.errors.leak},
                {"acne", row.errors.acne},
                {"max_abs", row.errors.max_abs},
                {"max_dark", row.errors.max_dark},
                {"darkened", row.errors.darkened},
                {"ns_per_receiver", row.ns_per_receiver},
                {"build_ms", row.build_ms},
                {"real", row.real},
                {"lanes", row.lanes},
                {"threads", row.threads}};
    if (row.acne_unbiased) result["acne_unbiased"] = *row.acne_unbiased;
    if (!row.device.empty()) result["device"] = row.device;
    for (const auto& [name, milliseconds] : row.passes) result[name + "_ms"] = milliseconds;
    return result;
}

bool same_key(const json& a, const json& b)
{
    constexpr const char* key[] = {"scene", "method", "format", "reference", "real", "lanes", "threads", "device"};
    return std::ranges::all_of(key, [&](const char* name) { return a.value(name, json()) == b.value(name, json()); });
}

json read_report(const std::filesystem::path& file)
{
    if (!std::filesystem::exists(file)) return json::array();
    json report = json::parse(read_file(file), nullptr, false);
    if (!report.is_array() || !std::ranges::all_of(report, [](const json& row) { return row.is_object(); }))
        throw std::runtime_error(fmt::format("{}: not an array of report rows", file.string()));
    return report;
}

} // namespace

error_statistics compare(std::span<const float> estimate, std::span<const float> reference)
{
    if (estimate.size() != reference.size() || estimate.empty())
        throw std::invalid_argument(
            fmt::format("compare: {} estimates, {} references", estimate.size(), reference.size()));
    error_statistics sum;
    std::size_t lit = 0, darkened = 0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        const double error = double(estimate[i]) - double(reference[i]);
        sum.rmse += error * error;
        sum.leak += std::max(error, 0.0);
        sum.acne += std::max(-error, 0.0);
        sum.max_abs = std::max(sum.max_abs, std::abs(error));
        sum.max_dark = std::max(sum.max_dark, -error);
        if (reference[i] >= 0.5f) ++lit, darkened += -error >= too_dark;
    }
    const auto count = static_cast<double>(estimate.size());
    return {.rmse = std::sqrt(sum.rmse / count),
            .mean_abs = (sum.leak + sum.acne) / count,
            .leak = sum.leak / count,
            .acne = sum.acne / count,
            .max_abs = sum.max_abs,
            .max_dark = sum.max_dark,
            .darkened = lit == 0 ? 0 : double(darkened) / double(lit)};
}

void merge_report(const std::filesystem::path& file, std::span<const report_row> rows)
{
    json report = read_report(file);
    for (const report_row& row : rows) {
        json fresh = to_json(row);
        for (const auto& [name, value] : fresh.items())
            if (value.is_number_float() && !std::isfinite(value.get<double>()))
                throw std::runtime_error(fmt::format("{}: {} of {} in {} is {}", file.string(), name, row.method,
                                                     row.scene, value.get<double>()));
        const auto old = std::ranges::find_if(report, [&](const json& other) { return same_key(other, fresh); });
        if (old == report.end()) report.push_back(std::move(fresh));
        else *old = std::move(fresh);
    }
    write_file(file, report.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

} // namespace gnomon::renderer
