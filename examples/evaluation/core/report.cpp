#include "report.hpp"

#include "renderer/output/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::evaluation {

namespace {

using json = nlohmann::ordered_json;

json to_json(const report_row& row)
{
    json result{{"scene", row.scene},
                {"part", row.part},
                {"method", row.method},
                {"family", row.family},
                {"map", row.map},
                {"receiver", row.receiver},
                {"format", row.format},
                {"parameters", json::object()},
                {"label", row.label},
                {"reference", row.reference},
                {"receivers", row.receivers},
                {"bytes_per_texel", row.bytes_per_texel},
                {"map_bytes", row.map_bytes},
                {"rmse", row.errors.rmse},
                {"mean_abs", row.errors.mean_abs},
                {"leak", row.errors.leak},
                {"acne", row.errors.acne},
                {"max_abs", row.errors.max_abs},
                {"max_dark", row.errors.max_dark},
                {"darkened", row.errors.darkened}};
    for (const auto& [name, value] : row.parameters) result["parameters"][name] = value;
    const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value) result[name] = *value;
    };
    add("noise", row.noise), add("bias", row.bias);
    add("noise_beyond_exact", row.noise_beyond_exact);
    add("noise_beyond_camera", row.noise_beyond_camera), add("noise_of_map", row.noise_of_map);
    add("acne_unbiased", row.acne_unbiased);
    add("ns_kernel", row.ns_kernel);
    result["ns_per_receiver"] = row.ns_per_receiver;
    result["build_ms"] = row.build_ms;
    result["real"] = row.real;
    result["lanes"] = row.lanes;
    result["threads"] = row.threads;
    result["device"] = row.device;
    result["seeds"] = row.seeds;
    for (const auto& [name, milliseconds] : row.passes) result[name + "_ms"] = milliseconds;
    return result;
}

bool same_identity(const json& a, const json& b)
{
    constexpr const char* identity[] = {"scene",      "part",      "method", "family", "map",     "receiver", "format",
                                        "parameters", "reference", "real",   "lanes",  "threads", "device"};
    return std::ranges::all_of(identity,
                               [&](const char* name) { return a.value(name, json()) == b.value(name, json()); });
}

// The path of the first number that JSON cannot hold; empty where there is none.
std::string not_finite(const json& object)
{
    for (const auto& [name, value] : object.items()) {
        if (value.is_number_float() && !std::isfinite(value.get<double>())) return name;
        if (value.is_object())
            if (const std::string within = not_finite(value); !within.empty())
                return fmt::format("{}.{}", name, within);
    }
    return {};
}

json read_report(const std::filesystem::path& file)
{
    if (!std::filesystem::exists(file)) return json::array();
    json report = json::parse(renderer::read_file(file), nullptr, false);
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

report_row row_of(const method& m)
{
    return {.method = m.id,
            .family = m.family,
            .map = m.map,
            .format = m.format.id,
            .parameters = m.parameters,
            .label = m.label,
            .bytes_per_texel = m.format.bytes_per_texel};
}

void merge_report(const std::filesystem::path& file, std::span<const report_row> rows)
{
    json report = read_report(file);
    for (const report_row& row : rows) {
        json fresh = to_json(row);
        if (const std::string name = not_finite(fresh); !name.empty())
            throw std::runtime_error(
                fmt::format("{}: {} of {} in {} is not finite", file.string(), name, row.method, row.scene));
        const auto old = std::ranges::find_if(report, [&](const json& other) { return same_identity(other, fresh); });
        if (old == report.end()) report.push_back(std::move(fresh));
        else *old = std::move(fresh);
    }
    renderer::write_file(file, report.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

} // namespace gnomon::evaluation
