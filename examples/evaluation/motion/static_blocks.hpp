// Blocks of a page about static receivers: a table, and in words which of ranges and accumulated maps are faster.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"

#include <span>

namespace gnomon::evaluation {

// Parts of the scene where receivers are: on the ground behind all casters, and among them.
inline constexpr const char *behind_all = "ground", *among_casters = "among";

// Rays that others are compared with.
inline constexpr int least_rays = 16;

bool has_tent(const report_row& row);

// Rows of all speeds and parts, with the parameter "speed".
block static_table(std::span<const report_row> rows);

} // namespace gnomon::evaluation
