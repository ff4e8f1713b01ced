// The page of a comparison: methods side by side, speed against accuracy, numbers, and every method's pictures.
#pragma once

#include "comparison.hpp"
#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "shaded_stage.hpp"

#include <string>
#include <vector>

namespace gnomon::evaluation {

inline constexpr float error_scale = 0.5f; // visibility at which error colours saturate

struct compared_part {
    std::string id, name, colour; // of an inset; the whole picture is the part without an id
};

// The picture of a method is FILE.png, its errors against a reference are in FILE-REFERENCE.png.
struct compared_method {
    const shadow_method* of;
    std::string file;
    std::vector<report_row> rows;

    // False for a method that filters as the reference does: the reference cannot judge such a method.
    bool is_filterable() const;

    // The row of one receiver at a time, or of the most at a time.
    const report_row& row(const std::string& reference, const std::string& part = {}, bool by_packs = false) const;
};

struct compared_stage {
    comparison_facts facts;
    settings how;
    std::string title; // of the model or the scene
    std::size_t receivers, taps;
    std::vector<compared_part> insets;
    std::vector<const hard_reference*> references; // pictures in REFERENCE.png; the first is that of most numbers
    std::vector<compared_method> methods;
};

// The table of all numbers, a row for each method.
table_block comparison_numbers(const compared_stage& stage);

page comparison_page(const compared_stage& stage);

} // namespace gnomon::evaluation
