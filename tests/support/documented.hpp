// Tables in the documentation whose numbers tests check against measurements.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test {

/// The row "| KEY | ..." in a file behind its key; path is relative to the root of the project. KEY may have bars.
inline std::string documented_row(const std::string& path, const std::string& key)
{
    std::ifstream file(std::filesystem::path(__FILE__).parent_path() / "../.." / path);
    const std::string begin = "| " + key + " |";
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(begin)) return line.substr(begin.size());
    return {};
}

/// The numbers of the row "| KEY | number | ...", up to a cell that is none.
inline std::vector<double> documented(const std::string& path, const std::string& key)
{
    std::istringstream cells(documented_row(path, key));
    std::vector<double> numbers;
    double x = 0;
    for (char bar = 0; cells >> x >> bar && bar == '|';) numbers.push_back(x);
    return numbers;
}

} // namespace gnomon::test
