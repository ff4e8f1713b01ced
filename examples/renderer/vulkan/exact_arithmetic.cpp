#include "exact_arithmetic.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

namespace gnomon::renderer::vulkan {

namespace {

// Numbers of the standard. An instruction begins with a word of its length and its number.
constexpr std::size_t header = 5;
constexpr std::uint32_t decorate = 71, no_contraction = 42, first_type = 19, last_type = 39;
constexpr std::array operations{127u, 129u, 131u, 133u, 136u, 140u, 141u, 142u, 143u, 144u, 145u, 146u, 147u, 148u};

} // namespace

std::vector<std::uint32_t> exact_arithmetic(std::span<const std::uint32_t> spirv)
{
    std::vector<std::uint32_t> decorations;
    std::size_t place = 0; // of the first decoration or type: decorations come after names, and before types
    for (std::size_t at = header; at < spirv.size(); at += spirv[at] >> 16) {
        const std::uint32_t number = spirv[at] & 0xffff, length = spirv[at] >> 16;
        if (length == 0 || at + length > spirv.size()) throw std::invalid_argument("exact_arithmetic: no SPIR-V");
        if (place == 0 && (number == decorate || (first_type <= number && number <= last_type))) place = at;
        if (std::ranges::find(operations, number) != operations.end())
            decorations.insert(decorations.end(), {3u << 16 | decorate, spirv[at + 2], no_contraction});
    }
    std::vector<std::uint32_t> result(spirv.begin(), spirv.end());
    result.insert(result.begin() + std::ptrdiff_t(place), decorations.begin(), decorations.end());
    return result;
}

} // namespace gnomon::renderer::vulkan
