// Messages of a long program while it runs, on the standard error stream.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::evaluation {

// Prints a line of progress.
void progress(std::string_view driver, std::string_view what);

// Work of a driver that is known to have so many steps.
class steps {
  public:
    steps(std::string driver, std::size_t count) : driver_(std::move(driver)), count_(count) {}

    // Prints a line of progress that begins with the number of this step and of all. Any thread may call it.
    void begin(std::string_view what);

  private:
    std::string driver_;
    std::size_t count_;
    std::atomic<std::size_t> begun_ = 0;
};

} // namespace gnomon::evaluation
