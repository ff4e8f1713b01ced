// What the demo leaves behind in numbers: error statistics, and rows of out/report.json.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::renderer {

// Of visibility estimates E against references V over all receivers. leak is the mean of max(0, E - V), acne the mean
// of max(0, V - E) and max_dark the largest V - E; darkened is the share that is too dark by too_dark and more among
// what is lit, with V of half and more, 0 where nothing is.
struct error_statistics {
    double rmse = 0, mean_abs = 0, leak = 0, acne = 0, max_abs = 0, max_dark = 0, darkened = 0;
};
inline constexpr double too_dark = 0.05;

error_statistics compare(std::span<const float> estimate, std::span<const float> reference);

struct report_row {
    std::string scene, method, format;
    std::string reference; // "filtered", "traced" or "closed-form"; of a device "cpu": the same method there
    long long receivers = 0;
    double bytes_per_texel = 0;
    error_statistics errors;
    std::optional<double> acne_unbiased{}; // of the same receivers without depth bias
    double ns_per_receiver = 0, build_ms = 0;
    std::string real = "float";
    int lanes = 1, threads = 1;
    std::string device{};                                 // what it ran on where that is no thread of the CPU
    std::vector<std::pair<std::string, double>> passes{}; // milliseconds of the device, each in a field NAME_ms
};

// Puts rows into the file, an array of flat objects. A row replaces the one with the same scene, method, format,
// reference, real, lanes, threads and device; other rows stay as they are. The file is written aside and renamed.
// Throws std::runtime_error "FILE: cause", and leaves the file alone, where it holds something else or a number is not
// finite.
void merge_report(const std::filesystem::path& file, std::span<const report_row> rows);

} // namespace gnomon::renderer
