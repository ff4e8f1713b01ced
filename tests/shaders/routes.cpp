#include "route.hpp"

#include <cstdlib>

namespace gnomon::parity {

std::filesystem::path built(const std::string& name)
{
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

#if !defined(GNOMON_PARITY_VULKAN)
std::unique_ptr<route> vulkan_route(const std::filesystem::path&, const std::string&, const std::string&)
{
    throw unavailable("built without Vulkan's headers or glslangValidator");
}
#endif
#if !defined(GNOMON_PARITY_OPENCL)
std::unique_ptr<route> opencl_route(const std::filesystem::path&, const std::string&)
{
    throw unavailable("built without OpenCL's headers");
}
#endif
#if !defined(GNOMON_PARITY_GLES)
std::unique_ptr<route> gles_route(const std::filesystem::path&)
{
    throw unavailable("built without the headers of EGL and OpenGL ES");
}
std::unique_ptr<route> fragment_route(const std::filesystem::path&, bool)
{
    throw unavailable("built without the headers of EGL and OpenGL ES");
}
#endif

namespace {

/// Chromium's driver on the CPU.
std::string swiftshader()
{
    std::string icd = "/usr/lib/chromium/vk_swiftshader_icd.json";
    if (!std::filesystem::exists(icd)) throw unavailable("no SwiftShader (chromium)");
    return icd;
}

/// shaders: kernels.wgsl, or a folder of SPIR-V, which naga turns into WGSL.
std::unique_ptr<route> dawn_route(const std::filesystem::path& shaders, const std::string& backend = "vulkan")
{
    const auto program = built("dawn/run.mjs");
    if (!exists(shaders) || !exists(program.parent_path() / "node_modules"))
        throw unavailable("not built: target gnomon_heavy");
    return command_route("node '" + program.string() + "' " + backend + " '" + shaders.string() + '\'',
                         backend == "vulkan" ? "Dawn on SwiftShader" : "Dawn on Mesa's OpenGL ES");
}

std::unique_ptr<route> webgl_route(const std::filesystem::path& shaders)
{
    if (!exists(shaders)) throw unavailable("not built: target gnomon_heavy");
    return served_route("python3 '" + std::string(GNOMON_WEBGL) + "/serve.py' '" + shaders.string() + '\'');
}

std::unique_ptr<route> heavy_module(const std::string& name)
{
    const auto file = built(name + ".so");
    if (!exists(file)) throw unavailable("not built: target gnomon_heavy");
    return module_route(file);
}

} // namespace

const std::vector<named_route>& all_routes()
{
    const auto host = [](const std::string& name) {
        return named_route{name, [name] { return module_route(built("host_" + name + ".so")); }};
    };
    // Mesa's driver on the CPU, wherever Debian's architectures put it.
    const auto lavapipe = [](const std::string& language, const std::string& name, const std::string& ending) {
        return named_route{name.front() == '-' ? language + name : name, [language, ending] {
                               for (const auto* machine : {"x86_64", "aarch64"}) {
                                   const auto icd = std::string("/usr/share/vulkan/icd.d/lvp_icd.") + machine + ".json";
                                   if (std::filesystem::exists(icd)) return vulkan_route(built(language), icd, ending);
                               }
                               throw unavailable("no lavapipe (mesa-vulkan-drivers)");
                           }};
    };
    static const std::vector<named_route> routes{
        {"fused", [] { return fused_against_split_route(built("host_scalar.so")); }},
        host("4lanes"),
        host("8lanes"),
        host("16lanes"),
        host("wide"),
        lavapipe("glsl", "-lavapipe", ".exact.spv"),
        lavapipe("hlsl", "-lavapipe", ".exact.spv"),
        lavapipe("glsl", "-plain", ".spv"),
        lavapipe("hlsl", "-plain", ".spv"),
        {"glsl-vulkan", [] { return vulkan_route(built("glsl"), ""); }},
        {"glsl-swiftshader", [] { return vulkan_route(built("glsl"), swiftshader()); }},
        {"hlsl-swiftshader", [] { return vulkan_route(built("hlsl"), swiftshader()); }},
        {"wgsl-dawn", [] { return dawn_route(built("wgsl/kernels.wgsl")); }},
        {"wgsl-plain", [] { return dawn_route(built("wgsl_plain/kernels.wgsl")); }},
        {"wgsl-plain-gles", [] { return dawn_route(built("wgsl_plain/kernels.wgsl"), "opengles"); }},
        {"naga-dawn", [] { return dawn_route(built("naga")); }},
        {"essl-gles", [] { return gles_route(built("essl")); }},
        {"essl300-gles", [] { return fragment_route(built("essl300_kept"), true); }},
        {"essl300-gles-plain", [] { return fragment_route(built("essl300"), true); }},
        {"essl300-webgl", [] { return webgl_route(built("essl300_kept")); }},
        {"essl300-webgl-plain", [] { return webgl_route(built("essl300")); }},
        {"cross-essl310", [] { return gles_route(built("translated/cross_essl310")); }},
        {"cross-essl300", [] { return fragment_route(built("translated/cross_essl300"), true); }},
        {"cross-glsl330", [] { return fragment_route(built("translated/cross_glsl330"), false); }},
        {"naga-essl300", [] { return fragment_route(built("translated/naga_essl300"), true); }},
        {"naga-glsl330", [] { return fragment_route(built("translated/naga_glsl330"), false); }},
        lavapipe("translated/cross_hlsl", "cross-hlsl", ".spv"),
        lavapipe("translated/naga_hlsl", "naga-hlsl", ".spv"),
        {"cross-msl", [] { return heavy_module("translated/cross_msl"); }},
        {"naga-msl", [] { return heavy_module("translated/naga_msl"); }},
        {"opencl-pocl", [] { return opencl_route(built("opencl/kernels.cl"), "Portable Computing Language"); }},
        {"metal-shim", [] { return module_route(built("metal.so")); }},
        {"metal-fast", [] { return heavy_module("metal_fast"); }},
        {"cuda", [] { return module_route(built("cuda.so")); }},
    };
    return routes;
}

} // namespace gnomon::parity
