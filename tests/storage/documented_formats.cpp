// The table of formats in docs/shaders.md: size, darkening, textures, border colour and the names of kernels.
#include "support/documented.hpp"

#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <string>
#include <tuple>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Bytes and channels of a texture by its name: letters, the bits of a letter, the bits of further letters.
struct texture_size {
    std::size_t bytes, channels;
};

texture_size size_of(const std::string& texture)
{
    const std::size_t letters = texture.find_first_of("0123456789");
    const std::size_t bits = std::stoul(texture.substr(letters));
    // Two further bits of alpha hold no channel.
    const std::size_t further = texture.find('_') == std::string::npos ? 0 : 2;
    return {(letters * bits + further) / 8, letters};
}

/// The sizes of "N `TEXTURE`" everywhere in a row, summed.
texture_size size_of_all(const std::string& row)
{
    texture_size sum{0, 0};
    for (std::size_t i = row.find(" `"); i != std::string::npos; i = row.find(" `", i + 1)) {
        if (!std::isdigit(static_cast<unsigned char>(row[i - 1]))) continue;
        const std::size_t count = std::size_t(row[i - 1] - '0');
        const texture_size one = size_of(row.substr(i + 2, row.find('`', i + 2) - i - 2));
        sum.bytes += count * one.bytes;
        sum.channels += count * one.channels;
    }
    return sum;
}

template <class Format> void check_row()
{
    CAPTURE(Format::id);
    const std::string id(Format::id), key = "`" + id + "`";
    const std::string row = documented_row("docs/shaders.md", key);
    const std::vector<double> stated = documented("docs/shaders.md", key);
    REQUIRE(stated.size() == 3);
    CHECK(stated[0] == double(Format::bytes_per_texel));
    CHECK(stated[1] == doctest::Approx(double(Format::darkening)));
    CHECK(stated[2] == doctest::Approx(double(Format::filtered_darkening)));

    const texture_size textures = size_of_all(row);
    CHECK(textures.bytes == Format::bytes_per_texel);
    CHECK(textures.channels == channel_count<Format>);

    const auto border = std::bit_cast<channel_array<Format>>(Format::border());
    const bool white = std::all_of(border.begin(), border.end(), [](float c) { return c == 1; });
    CHECK(row.ends_with(white ? "| white |" : "| its own |"));

    // A function of its own for blurred maps is one whose results differ.
    const auto half = std::bit_cast<format_channels<Format>>([] {
        auto near = std::bit_cast<channel_array<Format>>(Format::from_depth(-0.5f));
        const auto far = std::bit_cast<channel_array<Format>>(Format::from_depth(0.5f));
        for (std::size_t k = 0; k < near.size(); ++k) near[k] = 0.5f * (near[k] + far[k]);
        return near;
    }());
    const bool own = Format::filtered_intensity(half, 0.2f) != Format::intensity(half, 0.2f);
    CHECK(row.find("| `" + id + (own ? "_filtered_intensity` |" : "_intensity` |")) != std::string::npos);
}

} // namespace

TEST_CASE("the documented table of formats is that of the types")
{
    [&]<class... Format>(std::tuple<Format...>*) {
        (check_row<Format>(), ...);
    }(static_cast<storage_formats*>(nullptr));
}
