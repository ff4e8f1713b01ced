// A guard against importers that fail on broken files: by an assertion, a wild pointer, recursion until the stack is
// full, or a header that promises 10^11 vertices. While a guard lives, memory is limited, so that the last kind ends in
// std::bad_alloc; the other kinds end the program with one line, "FILE: cause", and exit code 2. One guard at a time.
#pragma once

#include <sys/resource.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <vector>

namespace gnomon::renderer {

class import_guard {
  public:
    explicit import_guard(const std::filesystem::path& file);
    ~import_guard();
    import_guard(const import_guard&) = delete;
    import_guard& operator=(const import_guard&) = delete;

  private:
    static constexpr std::array signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    std::array<struct sigaction, signals.size()> earlier_actions_{};
    rlimit earlier_limit_{};
    std::vector<char> stack_; // for the handler, since the program's own may be full
    stack_t earlier_stack_{};
};

} // namespace gnomon::renderer
