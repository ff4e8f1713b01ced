// Compute shaders on Vulkan, with the validation layer: a driver that gives the right bits for an invalid call proves
// little. One buffer for inputs and one for results, a workgroup for each block.
#include "renderer/vulkan/device.hpp"
#include "route.hpp"
#include "support/kernel_call.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace gnomon::parity {

namespace {

namespace vulkan = renderer::vulkan;

std::vector<std::uint32_t> read_words(const std::filesystem::path& file)
{
    std::vector<std::uint32_t> words(file_size(file) / sizeof(std::uint32_t));
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(words.data()), std::streamsize(words.size() * sizeof(std::uint32_t)));
    return words;
}

class compute_shaders final : public route {
  public:
    compute_shaders(std::filesystem::path folder, std::string ending)
        : folder_(std::move(folder)), ending_(std::move(ending))
    {
        using controls = vk::PhysicalDeviceVulkan12Properties;
        const auto properties = gpu_.physical().getProperties2<vk::PhysicalDeviceProperties2, controls>();
        if (!properties.get<controls>().shaderSignedZeroInfNanPreserveFloat32)
            throw unavailable(device() + " does not keep NaN and the signs of zeros");
    }

    void run(const kernel& k, std::span<const float> in, std::span<float> out) override
    {
        const std::vector<std::uint32_t> code = read_words(folder_ / (k.name + ending_));
        const vulkan::buffer inputs(gpu_, in.size_bytes()), outputs(gpu_, out.size_bytes());
        std::ranges::copy(in, inputs.mapped<float>().begin());
        const vulkan::compute_pass pass(gpu_, {code}, {inputs, outputs});
        const auto groups = std::uint32_t(in.size() / (k.inputs * test::block_rows));
        gpu_.run([&](const vk::raii::CommandBuffer& commands) { pass.record(commands, {groups, 1, 1}); });
        std::ranges::copy(outputs.mapped<float>(), out.begin());
    }
    std::string device() const override { return gpu_.name(); }
    std::vector<std::string> complaints() const override { return gpu_.complaints(); }

  private:
    std::filesystem::path folder_;
    std::string ending_;
    vulkan::device gpu_{vulkan::validation::on};
};

} // namespace

std::unique_ptr<route> vulkan_route(const std::filesystem::path& folder, const std::string& icd,
                                    const std::string& ending)
try {
    if (!exists(folder)) throw unavailable("no shaders in " + folder.string());
    if (icd.empty()) unsetenv("VK_ICD_FILENAMES");
    else setenv("VK_ICD_FILENAMES", icd.c_str(), 1);
    return std::make_unique<compute_shaders>(folder, ending);
} catch (const vulkan::unavailable& why) {
    throw unavailable(why.what());
}

} // namespace gnomon::parity
