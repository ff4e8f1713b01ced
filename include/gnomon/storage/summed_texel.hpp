// Texels of summed-area tables (soft/summed_area.h), and the one interface of what passes/summed_area.hpp puts into them. A
// table is no storage format: interpolation of its texels would be of sums that have wrapped around, so a bilinear
// look-up of a table does not compile.
//
//     using table = gnomon::moments4_summed;
//     gnomon::build_summed_area<table>(depths, texels, most_texels);
//     auto c = gnomon::rectangle_average<table>(texels, most_texels, rectangle);
//     float shadow = table::intensity(c, most_texels, z_f);
#ifndef GNOMON_STORAGE_SUMMED_TEXEL_HPP
#define GNOMON_STORAGE_SUMMED_TEXEL_HPP

#include "format.hpp"

GNOMON_NAMESPACE_BEGIN

/// Types and functions that every summed-area table has:
///     texel, channels<Real>                    four corners of sums, modulo 2^32, and means of a rectangle
///     name, id                                 in words, and for programs: [a-z0-9_]
///     bytes_per_texel
///     from_depth(z)                            the channels of one depth, each in [0, 1]
///     from_samples(depths)                     the mean channels of depth samples, in double
///     codes(channels, scale)                   whole numbers; those of the border for channels that have a NaN
///     mean(sums, area, scale)                  the channels of a rectangle; the border for no area
///     intensity(channels, most_texels, z_f)    the shadow in a rectangle
///     blocker(channels, most_texels, z_f)      the mean depth of what is before z_f in a rectangle
///     darkening(most_texels)                   the most by which a lit surface is darkened
// clang-format off
template <class Table> concept summed_table = requires(float z, double w, const format_channels<Table>& c) {
    requires std::same_as<format_texel<Table>, std::array<std::uint32_t, sizeof(format_channels<Table>) / sizeof(float)>>;
    requires Table::bytes_per_texel == sizeof(format_texel<Table>);
    { Table::name } -> std::convertible_to<std::string_view>;
    { Table::id } -> std::convertible_to<std::string_view>;
    { Table::from_depth(z) } -> std::same_as<format_channels<Table>>;
    { Table::from_samples(std::array{z, z}) } -> std::same_as<format_channels<Table, double>>;
    { Table::codes(c, z) } -> std::same_as<format_channels<Table>>;
    { Table::mean(c, z, z) } -> std::same_as<format_channels<Table>>;
    { Table::intensity(c, z, z) } -> std::same_as<float>;
    { Table::blocker(c, z, z) } -> std::same_as<float>;
    { Table::darkening(w) } -> std::same_as<double>;
};
// clang-format on

/// A texel of sums, one for each channel, in order.
template <template <class...> class Channels> struct summed_texel : coded_texel<Channels, std::uint32_t> {};

GNOMON_NAMESPACE_END
#endif
