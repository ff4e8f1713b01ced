// Messages of a long program while it runs.
#pragma once

#include <string_view>

namespace gnomon::evaluation {

// Prints a line of progress to the standard error stream.
void progress(std::string_view driver, std::string_view what);

} // namespace gnomon::evaluation
