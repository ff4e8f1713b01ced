// Tables in the documentation whose numbers tests check against measurements.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test {

/// The numbers of the row "| KEY | number | ..." in a file; path is relative to the root of the project. KEY
/// may have bars.
inline std::vector<double> documented(const std::string& path, const std::string& key)
{
    std::ifstream file(std::filesystem::path(__FILE__).parent_path() / "../.." / path);
    const std::string begin = "| " + key + " |";
    std::vector<double> numbers;
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(begin)) continue;
        std::istringstream cells(line.substr(begin.size()));
        double x = 0;
        for (char bar = 0; cells >> x >> bar;) numbers.push_back(x);
        break;
    }
    return numbers;
}

} // namespace gnomon::test
