// Parity: one kernel text, many ways to run it, the same bits. This is what a way to run it, a route, must do.
//
// To add a route: write a class below `route` whose constructor throws `unavailable` where the machine lacks something,
// give it a line in routes.cpp, and a test in CMakeLists.txt. A shared object that exports module.hpp, and a command
// that reads and writes files, need no class: module_route and command_route run them. A text around each kernel in
// another language comes from shaders.py.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::parity {

/// A kernel by its shape: how many numbers go in and come out, in the blocks of ../support/kernel_call.hpp; unit:
/// whether they come out in [0, 1] whatever goes in.
struct kernel {
    const char* name;
    std::size_t inputs, outputs;
    const char* families;
    bool unit;
};

/// Source of a product's error in two_product (numerics/two_product.h): by Dekker's splitting, as shaders do, or by
/// fused multiply-add. Both give the same bits but where products leave the comment's domain. So a route is compared
/// with a host of its own kind; whether the two hosts agree within the domain is a route of its own.
enum class products { split, fused, fused_against_split };

class route {
  public:
    route() = default;
    route(const route&) = delete;
    route& operator=(const route&) = delete;
    virtual ~route() = default;

    /// Runs the kernel over whole blocks.
    virtual void run(const kernel& k, std::span<const float> in, std::span<float> out) = 0;

    /// The place where a route runs, for the report: a driver's own name, say.
    [[nodiscard]] virtual std::string device() const = 0;

    [[nodiscard]] virtual products computes() const { return products::split; }

    /// Words of a validation layer after the last kernel: any word is a failure.
    [[nodiscard]] virtual std::vector<std::string> complaints() const { return {}; }
};

/// Why a route cannot run here: skipped on a desktop, a failure under CI=true.
struct unavailable : std::runtime_error {
    using runtime_error::runtime_error;
};

struct named_route {
    std::string name;
    std::function<std::unique_ptr<route>()> make;
};

/// Every route, by name.
const std::vector<named_route>& all_routes();

/// The folder of modules and shaders: beside the program.
std::filesystem::path built(const std::string& name);

/// Of a shared object that exports module.hpp.
std::unique_ptr<route> module_route(const std::filesystem::path& file);
std::unique_ptr<route> fused_against_split_route(const std::filesystem::path& file);

/// Of a command that is called as LINE KERNEL INPUTS OUTPUTS IN OUT: how many numbers, and files of floats; exit
/// code 77 says that it cannot run here, and its last line why.
std::unique_ptr<route> command_route(std::string line, std::string device);

/// Of a command that stays. It says "ready DEVICE" or "unavailable WHY" in a line; then it reads lines KERNEL INPUTS OUTPUTS
/// IN OUT, as above, and says "done" to each.
std::unique_ptr<route> served_route(const std::string& line);

/// Of modules FOLDER/KERNELending on the Vulkan drivers that icd names (VK_ICD_FILENAMES), all drivers where it is
/// empty.
std::unique_ptr<route> vulkan_route(const std::filesystem::path& folder, const std::string& icd,
                                    const std::string& ending = ".exact.spv");

/// Of texts FOLDER/KERNEL.comp in ESSL, on Mesa's OpenGL ES for the CPU.
std::unique_ptr<route> gles_route(const std::filesystem::path& folder);

/// Of texts FOLDER/KERNEL.frag in ESSL 300, es, or GLSL 330, on Mesa's OpenGL ES 3.0 or OpenGL 3.3 for the CPU. A fragment
/// with f = 2048 y + x computes results 4 p to 4 p + 3 of row f / n, where n = ceil(outputs / 4) and p = f % n, into one
/// output of type uvec4. Number i of the blocks is in the only texture, of type usampler2D, at (i % 2048, i / 2048).
std::unique_ptr<route> fragment_route(const std::filesystem::path& folder, bool es);

/// Of FILE, OpenCL C with a function parity_KERNEL for each kernel, on the first device of the platform.
std::unique_ptr<route> opencl_route(const std::filesystem::path& file, const std::string& platform);

} // namespace gnomon::parity
