// The parts of the page of vulkan_shadows: blocks of it, and rows of the report.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "side_by_side.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

inline constexpr const char* vulkan_driver = "vulkan_shadows";

struct page_part {
    std::vector<block> blocks;
    std::vector<report_row> rows;
};

// Translucent surfaces that blend into a map, soft shadows from a summed-area table, single scattering, and shadows of what
// moves, in maps of ranges and of layers.
page_part translucent_part(const renderer::vulkan::device& gpu, const settings& how);
page_part soft_part(const renderer::vulkan::device& gpu, const settings& how);
page_part scattering_part(const renderer::vulkan::device& gpu, const settings& how);
page_part range_part(const renderer::vulkan::device& gpu, const settings& how);
page_part layer_part(const renderer::vulkan::device& gpu, const settings& how);

// Files ID-device.png, ID-cpu.png and ID-difference.png in the folder of the driver, and the block that shows them. The
// subject says in words what they show.
struct compared_pictures {
    std::string id, title, subject;
    error_statistics errors;
};
struct host_picture {
    renderer::picture colour;
    renderer::image<float> visibility;
};
void write_pictures(const std::string& id, const settings& how, const device_frame& device, const host_picture& host);
void write_pictures(const std::string& id, const settings& how, const device_frame& device,
                    const renderer::stage& scenery, const device_comparison& comparison,
                    const renderer::image<float>& host);
pictures_block pictures_of(const compared_pictures& shown);

// A pass, and the bytes that it reads and writes in memory.
struct moving_pass {
    std::string label;
    double milliseconds, bytes;
};

// Times of passes, and bytes per second beside those of a copy.
table_block moved_bytes(const std::string& title, const std::string& text, std::span<const moving_pass> passes,
                        const moving_pass& copy);

// The time of a pass of this name.
double milliseconds_of(const device_frame& frame, std::string_view name);

// A row for a method of the registry, compared with the CPU.
report_row device_row(const method& m, const std::string& scene, const std::string& device, const device_frame& frame,
                      const error_statistics& errors, std::size_t receivers);

} // namespace gnomon::evaluation
