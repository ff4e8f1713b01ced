// How much a randomised test draws. A test names the count of a full run; GNOMON_TEST_EFFORT=quick (sanitizers,
// second compiler) takes a hundredth of it, GNOMON_TEST_EFFORT=long a hundred times as much.
#ifndef GNOMON_TESTS_SUPPORT_EFFORT_HPP
#define GNOMON_TESTS_SUPPORT_EFFORT_HPP

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace gnomon::test {

inline std::int64_t effort(std::int64_t full)
{
    const char* word = std::getenv("GNOMON_TEST_EFFORT");
    if (word == nullptr || std::string_view(word) == "full") return full;
    if (std::string_view(word) == "quick") return std::max<std::int64_t>(full / 100, 1);
    if (std::string_view(word) == "long") return full * 100;
    std::fprintf(stderr, "GNOMON_TEST_EFFORT=%s: quick, full or long expected\n", word);
    std::exit(2);
}

/// True where only a part of the draws of a full run is made, so that rare ones may be missing.
inline bool draws_few() { return effort(100) < 100; }

} // namespace gnomon::test
#endif
