#include "progress.hpp"

#include <fmt/format.h>

#include <cstdio>

void gnomon::evaluation::progress(std::string_view driver, std::string_view what)
{
    fmt::print(stderr, "demo: {}: {}\n", driver, what);
}
