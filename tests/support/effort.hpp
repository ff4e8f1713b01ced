// The number of draws of a randomised test. A test names the number of a full run. GNOMON_TEST_EFFORT=quick (for
// sanitizers and the second compiler) makes a hundredth of it, GNOMON_TEST_EFFORT=long a hundred times as many.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace gnomon::test {

/// The number of draws of this run, for a number of draws of a full run.
inline std::int64_t effort(std::int64_t full)
{
    const char* word = std::getenv("GNOMON_TEST_EFFORT");
    if (word == nullptr || std::string_view(word) == "full") return full;
    if (std::string_view(word) == "quick") return std::max<std::int64_t>(full / 100, 1);
    if (std::string_view(word) == "long") return full * 100;
    std::fprintf(stderr, "GNOMON_TEST_EFFORT=%s: quick, full or long expected\n", word);
    std::exit(2);
}

/// True if this run makes fewer draws than a full run, so that rare ones may be missing.
inline bool draws_few() { return effort(100) < 100; }

} // namespace gnomon::test
