// Blocks of a scene with scattering air that is rendered by every method.
#pragma once

#include "hazy_scene.hpp"
#include "scattering_comparison.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// What a comparison of its own adds to the page and to the report.
struct page_part {
    std::vector<block> blocks;
    std::vector<report_row> rows;
};

// Two methods side by side, of which these two are first seen; numbers; speed against accuracy; pictures of errors.
std::vector<block> blocks_of(const compared_scattering_scene& scene, const std::array<std::string, 2>& first);

// The pictures of a figure of the paper side by side, by those of its methods that the scene compares.
block block_of(const compared_scattering_scene& scene, const paper_figure& figure);

// Words for a picture, for those who cannot see the picture.
std::string alt_of(const compared_scattering_scene& scene, const scattering_row_set& method);

// Colours of error pictures with their meaning.
std::vector<std::pair<std::string, std::string>> key_of_errors();

} // namespace gnomon::evaluation
