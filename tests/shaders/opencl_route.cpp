// OpenCL C: one program with a function for each kernel, a workgroup for each block.
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#include "renderer/output/file.hpp"
#include "route.hpp"
#include "support/kernel_call.hpp"

#include <CL/opencl.hpp>

namespace gnomon::parity {

namespace {

cl::Device first_device(const std::string& platform)
try {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    for (const cl::Platform& p : platforms) {
        if (p.getInfo<CL_PLATFORM_NAME>() != platform) continue;
        std::vector<cl::Device> devices;
        p.getDevices(CL_DEVICE_TYPE_ALL, &devices);
        return devices.front();
    }
    throw unavailable("no OpenCL platform " + platform);
} catch (const cl::Error& error) {
    throw unavailable(std::string("OpenCL: ") + error.what());
}

class opencl_program final : public route {
  public:
    opencl_program(const std::filesystem::path& file, const std::string& include, const std::string& platform)
        : device_(first_device(platform)),
          context_(device_),
          queue_(context_, device_),
          program_(context_, renderer::read_file(file))
    {
        // Correct rounding of roots and divisions is an option of the language that a device may lack.
        if ((device_.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) == 0)
            throw unavailable(device() + " does not round divisions and roots correctly");
        try {
            program_.build(("-cl-std=CL1.2 -cl-fp32-correctly-rounded-divide-sqrt -I" + include).c_str());
        } catch (const cl::Error&) {
            throw std::runtime_error(file.string() + ": " + program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_));
        }
    }

    void run(const kernel& k, std::span<const float> in, std::span<float> out) override
    {
        // OpenCL takes its arguments without const and leaves what is read alone.
        const cl::Buffer inputs(context_, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, in.size_bytes(),
                                const_cast<float*>(in.data()));
        const cl::Buffer outputs(context_, CL_MEM_WRITE_ONLY, out.size_bytes());
        cl::Kernel function(program_, (std::string("parity_") + k.name).c_str());
        function.setArg(0, inputs);
        function.setArg(1, outputs);
        queue_.enqueueNDRangeKernel(function, {}, cl::NDRange(in.size() / k.inputs), cl::NDRange(test::block_rows));
        queue_.enqueueReadBuffer(outputs, CL_TRUE, 0, out.size_bytes(), out.data());
    }
    std::string device() const override { return device_.getInfo<CL_DEVICE_NAME>(); }
    products computes() const override { return products::fused; }

  private:
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    cl::Program program_;
};

} // namespace

std::unique_ptr<route> opencl_route(const std::filesystem::path& file, const std::string& platform)
{
    return std::make_unique<opencl_program>(file, GNOMON_PARITY_OPENCL, platform);
}

} // namespace gnomon::parity
