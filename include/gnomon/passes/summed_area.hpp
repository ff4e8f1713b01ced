// Summed-area tables (soft/summed_area.h) of shadow maps in main memory, and look-ups of rectangles in them. No
// allocation. The table has as many texels as the map; look-ups never read beyond its edges.
//
//     using table = gnomon::moments4_summed;
//     std::vector<table::texel> texels(width * height);
//     const gnomon::map_view<table::texel> sums{texels, width, height};
//     gnomon::build_summed_area<table>(depths, sums, 784);                       // rectangles of up to 27 x 27 texels
//     const auto rectangle = gnomon::summed_area_around(x, y, 27.f, 27.f);
//     const float z_b = table::blocker(gnomon::grid_average<table>(sums, 784, rectangle), 784, z_f);
//
// Depths are several samples to a texel, and their channels are averaged: the resolve is part of the pass. Build the table
// at once, or in bands of rows on several threads, each in two steps with the sum over the bands above it between them:
//
//     gnomon::summed_area_total<table>(depths, most_texels, rows, total);        each band; then, from the top, add totals
//     gnomon::build_summed_area<table>(depths, sums, most_texels, rows, above);  each band
//
// The first step reads the band and writes one row; every texel of the table is written once. The two-pass form, as on GPUs,
// is summed_area_along_x and then summed_area_along_y. All have the same bits, since integers sum in any order.
#ifndef GNOMON_PASSES_SUMMED_AREA_HPP
#define GNOMON_PASSES_SUMMED_AREA_HPP

#include "map_view.hpp"
#include "summed_row.hpp"

#include <algorithm>

GNOMON_NAMESPACE_BEGIN

/// The largest number of texels that a table may be made for: beyond it a channel has fewer than 12 bits.
inline constexpr std::size_t summed_area_limit = std::size_t{1} << 20;

namespace detail {

template <class Table> using sums = format_texel<Table>;

template <class Table> void add_to(sums<Table>& a, const sums<Table>& b)
{
    for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
}

/// The scale of a table, of which every code is a float.
inline double table_scale(std::size_t most_texels) { return double(summed_area_scale(float(most_texels))); }

inline void expect_most_texels(std::string_view pass, std::size_t most_texels)
{
    GNOMON_EXPECTS(most_texels >= 4, mismatch(pass, "most_texels", most_texels, "the least that a look-up covers", 4));
    GNOMON_EXPECTS(most_texels <= summed_area_limit,
                   mismatch(pass, "most_texels", most_texels, "summed_area_limit", summed_area_limit));
}

/// The map's extent, which must be in the range of a look-up's positions.
template <class T> void expect_table(std::string_view pass, map_view<T> map)
{
    expect_map(pass, "table", map);
    GNOMON_EXPECTS(map.width <= 65536 && map.height <= 65536,
                   mismatch(pass, "table.width", map.width, "table.height", map.height));
}

/// The sums before line x and line y of the grid, which are 0 at the left and the upper edge.
template <class Table> sums<Table> sums_before(map_view<const sums<Table>> table, std::size_t x, std::size_t y)
{
    return x > 0 && y > 0 ? table(x - 1, y - 1) : sums<Table>{};
}

/// The sums over the texels from (x0, y0) to before (x1, y1), as numbers.
template <class Table>
std::array<double, channel_count<Table>> sums_between(const sums<Table>& low, const sums<Table>& left,
                                                      const sums<Table>& above, const sums<Table>& high)
{
    std::array<double, channel_count<Table>> r{};
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = double(high[k] - left[k] - above[k] + low[k]);
    return r;
}

/// The number of a line of the grid, at most 65536. Signed integers are the fastest to convert to.
inline std::size_t line_of(float line) { return std::size_t(std::int32_t(line)); }

/// The mean channels, from the sums over a rectangle of that area in a table of that scale; the border for no area. As
/// Table::mean, but for one rounding of a float.
template <summed_table Table>
format_channels<Table> mean_of(const std::array<double, channel_count<Table>>& sum, double area, double scale)
{
    std::array<double, channel_count<Table>> border = gnomon_bit_cast<decltype(border)>(Table::from_depth(1.0));
    const double whole = area * scale;
    std::array<float, channel_count<Table>> mean{};
    for (std::size_t k = 0; k < mean.size(); ++k)
        mean[k] = float((std::min)(area > 0 ? sum[k] / whole : border[k], 1.0));
    return gnomon_bit_cast<format_channels<Table>>(mean);
}

} // namespace detail

/// Build the given rows of the table of a map, from what the rows above sum up to: the row of the table above these rows,
/// or nothing for the first. Source has channels of Table, or arrays of depth samples.
template <summed_table Table, class Source>
void build_summed_area(map_view<const Source> source, map_view<format_texel<Table>> table, std::size_t most_texels,
                       row_range rows, std::span<const std::type_identity_t<format_texel<Table>>> above)
{
    constexpr std::string_view pass = "build_summed_area";
    expect_map(pass, "source", source);
    detail::expect_table(pass, table);
    expect_same_extent(pass, source, table);
    expect_rows(pass, table, rows);
    detail::expect_most_texels(pass, most_texels);
    GNOMON_EXPECTS(above.empty() || above.size() == table.width,
                   mismatch(pass, "above.size()", above.size(), "table.width", table.width));
    const double scale = detail::table_scale(most_texels);
    const format_texel<Table>* previous = above.empty() ? nullptr : above.data();
    for (std::size_t y = rows.first; y < rows.last; ++y) {
        format_texel<Table>* const row = &table(0, y);
        detail::sum_row<Table>(std::span(&source(0, y), source.width), scale, previous, row);
        previous = row;
    }
}

/// Build the table of a map.
template <summed_table Table, class Source>
void build_summed_area(map_view<const Source> source, map_view<format_texel<Table>> table, std::size_t most_texels)
{
    build_summed_area<Table>(source, table, most_texels, {0, table.height}, {});
}

/// Sum up a band of rows of a map to one row: what the table below the band has more than above.
template <summed_table Table, class Source>
void summed_area_total(map_view<const Source> source, std::size_t most_texels, row_range rows,
                       std::span<format_texel<Table>> total)
{
    constexpr std::string_view pass = "summed_area_total";
    expect_map(pass, "source", source);
    expect_rows(pass, source, rows);
    detail::expect_most_texels(pass, most_texels);
    GNOMON_EXPECTS(total.size() == source.width,
                   mismatch(pass, "total.size()", total.size(), "source.width", source.width));
    const double scale = detail::table_scale(most_texels);
    const format_texel<Table>* above = nullptr;
    for (std::size_t y = rows.first; y < rows.last; ++y, above = total.data())
        detail::sum_row<Table>(std::span(&source(0, y), source.width), scale, above, total.data());
    if (above == nullptr) std::fill(total.begin(), total.end(), format_texel<Table>{});
}

/// The first of two passes: the running sums of the codes along the given rows.
template <summed_table Table, class Source>
void summed_area_along_x(map_view<const Source> source, map_view<format_texel<Table>> table, std::size_t most_texels,
                         row_range rows)
{
    for (std::size_t y = rows.first; y < rows.last; ++y)
        build_summed_area<Table>(source, table, most_texels, {y, y + 1}, {});
}

/// The second of two passes: the running sums along y, in place.
template <summed_table Table> void summed_area_along_y(map_view<format_texel<Table>> table)
{
    detail::expect_table("summed_area_along_y", table);
    for (std::size_t y = 1; y < table.height; ++y)
        for (std::size_t x = 0; x < table.width; ++x) detail::add_to<Table>(table(x, y), table(x, y - 1));
}

/// The mean channels of a table of that scale over the texels between lines of the grid, a rectangle by summed_area_grow
/// within the map. Reads four texels. The border for no texels.
template <summed_table Table>
format_channels<Table> grid_mean(map_view<const format_texel<Table>> table, double scale,
                                 const summed_area_rectangle<float>& lines)
{
    const std::size_t x0 = detail::line_of(lines.x0), y0 = detail::line_of(lines.y0);
    const std::size_t x1 = detail::line_of(lines.x1), y1 = detail::line_of(lines.y1);
    const auto sum = detail::sums_between<Table>(
        detail::sums_before<Table>(table, x0, y0), detail::sums_before<Table>(table, x0, y1),
        detail::sums_before<Table>(table, x1, y0), detail::sums_before<Table>(table, x1, y1));
    return detail::mean_of<Table>(sum, double(lines.x1 - lines.x0) * double(lines.y1 - lines.y0), scale);
}

/// The mean channels of a table of that scale over a rectangle within the map, of which a texel counts by the area that the
/// rectangle has of it: parts along x and along y, by summed_area_split. Reads sixteen texels. The border for no area.
template <summed_table Table>
format_channels<Table> rectangle_mean(map_view<const format_texel<Table>> table, double scale,
                                      const summed_area_parts<float>& a, const summed_area_parts<float>& b)
{
    const std::array columns{detail::line_of(a.line0), detail::line_of(a.line1), detail::line_of(a.line2),
                             detail::line_of(a.line3)};
    const std::array rows{detail::line_of(b.line0), detail::line_of(b.line1), detail::line_of(b.line2),
                          detail::line_of(b.line3)};
    const std::array across{double(a.width0), double(a.width1), double(a.width2)};
    const std::array along{double(b.width0), double(b.width1), double(b.width2)};
    const bool left = columns[0] > 0, above = rows[0] > 0; // of all lines only the first may be an edge
    std::array<std::array<format_texel<Table>, 4>, 4> corners{};
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i)
            if ((i > 0 || left) && (j > 0 || above)) corners[j][i] = table(columns[i] - 1, rows[j] - 1);
    std::array<double, channel_count<Table>> sum{};
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto part =
                detail::sums_between<Table>(corners[j][i], corners[j + 1][i], corners[j][i + 1], corners[j + 1][i + 1]);
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += across[i] * along[j] * part[k];
        }
    return detail::mean_of<Table>(sum, double(summed_area_width(a)) * double(summed_area_width(b)), scale);
}

/// The mean channels of a table over the texels that a rectangle touches: clipped to the map, and shrunk where these are more
/// than most_texels. The border where nothing is left.
template <summed_table Table>
format_channels<Table> grid_average(map_view<const format_texel<Table>> table, std::size_t most_texels,
                                    const summed_area_rectangle<float>& rectangle)
{
    return grid_mean<Table>(
        table, detail::table_scale(most_texels),
        summed_area_grow(summed_area_clip(rectangle, float(table.width), float(table.height), float(most_texels))));
}

/// The mean channels of a table over a rectangle: clipped to the map, and shrunk where it touches more than most_texels. The
/// border where nothing is left.
template <summed_table Table>
format_channels<Table> rectangle_average(map_view<const format_texel<Table>> table, std::size_t most_texels,
                                         const summed_area_rectangle<float>& rectangle)
{
    const summed_area_rectangle<float> r =
        summed_area_clip(rectangle, float(table.width), float(table.height), float(most_texels));
    return rectangle_mean<Table>(table, detail::table_scale(most_texels), summed_area_split(r.x0, r.x1),
                                 summed_area_split(r.y0, r.y1));
}

GNOMON_NAMESPACE_END
#endif
