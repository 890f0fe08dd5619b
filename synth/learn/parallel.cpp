#include "synth/learn/parallel.hpp"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace viaface {

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& job) {
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::exception_ptr> failures(count);
    {
        std::vector<std::jthread> threads;
        for (std::size_t w = 0; w < workers; ++w) {
            threads.emplace_back([&, w] {
                for (std::size_t i = w; i < count; i += workers) {
                    try {
                        job(i);
                    } catch (...) {
                        failures[i] = std::current_exception();
                    }
                }
            });
        }
    }
    for (const auto& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

}  // namespace viaface
