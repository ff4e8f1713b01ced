#include "progress.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace gnomon::evaluation {

void progress(std::string_view driver, std::string_view what) { fmt::print(stderr, "demo: {}: {}\n", driver, what); }

void steps::begin(std::string_view what) { progress(driver_, fmt::format("{} of {}: {}", ++begun_, count_, what)); }

} // namespace gnomon::evaluation
