#include "passes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace gnomon::evaluation {

using namespace renderer;

std::vector<device_pass> timed(const vulkan::device& gpu, const std::vector<named_pass>& passes)
{
    constexpr int repetitions = 3;
    std::vector<device_pass> result;
    for (const named_pass& pass : passes) result.push_back({pass.name, std::numeric_limits<double>::infinity()});
    const vulkan::timeline times(gpu, std::uint32_t(passes.size()) + 1);
    for (int i = 0; i <= repetitions; ++i) {
        gpu.run([&](const vk::raii::CommandBuffer& commands) {
            std::uint32_t marks = 0;
            times.reset(commands);
            times.mark(commands, marks++);
            for (const named_pass& pass : passes) {
                pass.record(commands);
                times.mark(commands, marks++);
                vulkan::barrier(commands); // llvmpipe takes the time of a mark when commands after it have to wait
            }
        });
        const std::vector<double> milliseconds = times.milliseconds();
        for (std::size_t k = 0; i > 0 && k < result.size(); ++k)
            result[k].milliseconds = std::min(result[k].milliseconds, milliseconds[k]);
    }
    return result;
}

} // namespace gnomon::evaluation
