#include "motion_part.hpp"

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>

namespace gnomon::evaluation {

void run_tasks(const std::vector<std::function<void()>>& tasks, int at_once)
{
    std::atomic<std::size_t> next = 0;
    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(at_once));
    const auto work = [&](std::exception_ptr& failure) {
        try {
            for (std::size_t i = next++; i < tasks.size(); i = next++) tasks[i]();
        } catch (...) {
            failure = std::current_exception();
            next = tasks.size();
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < failures.size(); ++i) others.emplace_back(work, std::ref(failures[i]));
        work(failures[0]);
    }
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

} // namespace gnomon::evaluation
