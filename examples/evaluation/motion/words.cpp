#include "words.hpp"

#include <fmt/format.h>

namespace gnomon::evaluation {

std::string grouped(double value, int digits)
{
    std::string result = fmt::format("{:.{}f}", value, digits);
    const std::size_t point = result.find('.'), first = result[0] == '-' ? 1 : 0;
    for (std::size_t i = point == result.npos ? result.size() : point; i > first + 3;) result.insert(i -= 3, 1, ',');
    return result;
}

std::string ratio(double value) { return value < 1 ? fmt::format("1/{:g}", 1 / value) : fmt::format("{:g}", value); }

std::string so_many(double times) { return grouped(times, times >= 10 ? 0 : 1) + " x"; }

} // namespace gnomon::evaluation
