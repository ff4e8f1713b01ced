#include "model_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::renderer {

std::size_t find_animation(std::span<const std::string> names, std::string_view name)
{
    if (names.empty()) throw std::runtime_error("no animation in it");
    if (name.empty()) return 0;
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    std::string list;
    for (const std::string& known : names) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", known);
    throw std::runtime_error(fmt::format("no animation \"{}\"; there are {}", name, list));
}

void check_exposure(const exposure& when, std::string_view name, double duration)
{
    if (!(when.open <= when.closing))
        throw std::runtime_error(fmt::format("the shutter opens at {} s and closes at {} s", when.open, when.closing));
    for (const double time : {when.open, when.closing})
        if (!(time >= 0 && time <= duration))
            throw std::runtime_error(
                fmt::format("{} s is outside of animation \"{}\", which lasts {} s", time, name, duration));
}

} // namespace gnomon::renderer
