// Pages that drivers leave for the gallery: blocks, written to facts.json beside the driver's pictures. A block has
// a title and a text; texts may hold <b>, <i>, <sub>, <sup> and <a href>, and escaped() protects what must not be read
// as these.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::evaluation {

struct text_block {
    std::string title{}, text{};
};

// A number, words, or nothing.
using cell = std::variant<std::monostate, double, std::string>;

enum class best { none, low, high };

struct column {
    std::string key, label;
    std::optional<int> digits{};   // after the decimal point
    std::optional<double> scale{}; // of the number shown
    evaluation::best best = best::none;
    std::string hint{};
    std::string colour{}; // "#rrggbb", of a swatch before the label
};

struct table_row {
    std::vector<std::pair<std::string, cell>> cells; // by the columns' keys
    std::string colour{};                            // "#rrggbb"
    bool is_aside = false;                           // never the best
};

struct table_block {
    std::string title{}, text{};
    std::vector<column> columns;
    std::vector<table_row> rows;
    bool is_folded = false; // closed under its title until a click
};

struct shown_picture {
    std::string file, alt, caption{}; // the file's name in the driver's folder; alt is for those who cannot see it
};

struct pictures_block {
    std::string title{}, text{};
    int columns = 1;
    bool compare = false; // two of the pictures are chosen and shown side by side
    std::vector<shown_picture> pictures;
    bool is_folded = false;
    bool is_pixelated = false;                              // enlarged without smoothing
    std::vector<std::pair<std::string, std::string>> key{}; // "#rrggbb" and what that colour means in the pictures
    std::optional<std::pair<int, int>> shown{};             // the two that a comparison shows first
};

enum class scale { linear, log, symlog };

struct axis {
    std::string label;
    evaluation::scale scale = scale::linear;
    std::optional<double> threshold{}; // symlog: linear below
    std::optional<double> least{}, most{};
    std::vector<std::pair<double, std::string>> ticks{};
};

// Points are {x, y}, or {x, y, size} of a point, or {x, low, high} of a band. A rule is an upright line at {x, NaN} or a
// level one at {NaN, y}.
enum class style { points, line, steps, band, rule };

struct series {
    std::string label;
    std::string colour{}; // "#rrggbb"
    evaluation::style style = style::points;
    std::vector<std::vector<double>> points{};
    bool labelled = true;             // beside the points, else in the legend
    std::vector<std::string> texts{}; // one beside each point
    bool dashed = false;
    std::string marker{}; // circle, square, triangle, diamond, down, plus, cross, star or none
};

struct panel {
    std::string title{};
    axis x, y;
    bool pareto = false; // the front of points that none other beats in x and y is drawn
    std::vector<evaluation::series> series{};
    std::string size{}; // the third number of points, in words
};

struct chart_block {
    std::string title{}, text{};
    std::string name; // of its files, without suffix
    std::string alt, caption{};
    std::vector<panel> panels;
    bool is_front = false; // the one chart of the gallery's front page
    bool is_folded = false;
};

struct map_axis {
    axis along;
    std::vector<double> values;
};

struct map_layer {
    std::string label;
    std::vector<std::vector<std::optional<double>>> values; // a row for each value of y
};

struct map_block {
    std::string title{}, text{};
    std::string name;
    std::string alt, caption{};
    map_axis x, y;
    double threshold = 0; // greater values are failures, which are outlined
    std::string label;    // of the values
    std::vector<map_layer> maps;
};

using block = std::variant<text_block, table_block, pictures_block, chart_block, map_block>;

struct page {
    std::string driver, title, family, summary;
    std::optional<shown_picture> front{}; // on the gallery's front page
    std::vector<block> blocks{};
};

std::string escaped(std::string_view text);

// Writes FOLDER/facts.json. Throws std::invalid_argument "FOLDER: cause", and leaves the file alone, where a block lacks
// a text for those who cannot see, names a file that is not in the folder, has a number that is not finite, rows of other
// keys than its columns, or shares the name of a chart's file with another.
void write_page(const std::filesystem::path& folder, const page& what);

} // namespace gnomon::evaluation
