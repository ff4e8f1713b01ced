// Blocks of a page about scenes in motion: pictures and numbers of every method, and methods against accumulation.
#pragma once

#include "motion_part.hpp"
#include "scene_comparison.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// Sizes, the reference and the conditions of measuring, in words.
std::string words_of(const motion_settings& how);

void add_scene_blocks(const scene_results& scene, std::vector<block>& to);

// Scenes from close by that have a figure, with semi-analytic and analytic receivers.
void add_close_up_blocks(std::span<const scene_results> scenes, std::vector<block>& to);

// The cost of accumulation at the error of analytic receivers.
void add_equal_error_blocks(std::span<const scene_results> scenes, std::vector<block>& to);

// Rows without pictures: ids of surfaces, merges of full lists, and covers that are read first.
void add_surface_blocks(std::span<const scene_results> scenes, std::vector<block>& to);
void add_merge_blocks(std::span<const scene_results> scenes, std::vector<block>& to);
void add_cover_blocks(std::span<const scene_results> scenes, std::vector<block>& to);

// Colours of errors, for the keys of pictures.
std::vector<std::pair<std::string, std::string>> key_of_errors(double saturated);

// Columns of numbers that several tables have; errors in thousandths.
column error_column(std::string key, std::string label, int digits = 2);
column number_column(std::string key, std::string label, int digits = 0, best which = best::none);

} // namespace gnomon::evaluation
