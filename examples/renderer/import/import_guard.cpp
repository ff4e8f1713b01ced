#include "import_guard.hpp"

#include <unistd.h>

#include <algorithm>
#include <string>

namespace gnomon::renderer {

namespace {

constexpr rlim_t largest_data_segment = rlim_t{8} << 30;

std::string message; // made before it is needed: a signal handler must not allocate

extern "C" void give_up(int)
{
    // Nothing is left to do about a failed write.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
    _exit(2);
}

} // namespace

import_guard::import_guard(const std::filesystem::path& file) : stack_(static_cast<std::size_t>(SIGSTKSZ))
{
    message = file.string() + ": its reader crashed\n";
    stack_t stack{};
    stack.ss_sp = stack_.data();
    stack.ss_size = stack_.size();
    sigaltstack(&stack, &earlier_stack_);
    struct sigaction action {};
    action.sa_handler = give_up;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &earlier_actions_[i]);
    getrlimit(RLIMIT_DATA, &earlier_limit_);
#ifndef __SANITIZE_ADDRESS__ // whose own tables are larger
    rlimit limit = earlier_limit_;
    limit.rlim_cur = std::min(limit.rlim_cur, largest_data_segment);
    setrlimit(RLIMIT_DATA, &limit);
#endif
}

import_guard::~import_guard()
{
    setrlimit(RLIMIT_DATA, &earlier_limit_);
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &earlier_actions_[i], nullptr);
    sigaltstack(&earlier_stack_, nullptr);
}

} // namespace gnomon::renderer
