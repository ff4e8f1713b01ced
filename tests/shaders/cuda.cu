// The C++ text of every kernel on a CUDA device, as a module: compiled with --fmad=false, so that only two_product
// fuses.
#include "kernels.hpp"

#include "module.hpp"

#include <string>
#include <string_view>

namespace {

constexpr unsigned block_rows = 64; // of ../support/kernel_call.hpp, whose packs nvcc need not read

template <class T> __device__ T take(const float*& column)
{
    float numbers[sizeof(T) / sizeof(float)];
    for (float& x : numbers) {
        x = *column;
        column += block_rows;
    }
    T value;
    memcpy(&value, numbers, sizeof value);
    return value;
}

template <auto kernel, class Result, class... Arguments> struct call {
    Result result;
    __device__ explicit call(Arguments... a) : result(kernel(a...)) {}
};

template <auto kernel, class Result, class... Arguments>
__device__ void run_row(Result (*)(Arguments...), const float* in, float* out)
{
    constexpr std::size_t inputs = (sizeof(Arguments) + ...) / sizeof(float), outputs = sizeof(Result) / sizeof(float);
    const float* column = in + std::size_t{blockIdx.x} * (block_rows * inputs) + threadIdx.x;
    const call<kernel, Result, Arguments...> done{take<Arguments>(column)...}; // braces: left to right
    float numbers[outputs];
    memcpy(numbers, &done.result, sizeof numbers);
    for (std::size_t j = 0; j < outputs; ++j)
        out[std::size_t{blockIdx.x} * (block_rows * outputs) + j * block_rows + threadIdx.x] = numbers[j];
}

/// Memory of the device; all calls report their failure by what CUDA says next (cudaGetLastError).
struct device_memory {
    explicit device_memory(std::size_t bytes) { cudaMalloc(&at, bytes); }
    ~device_memory() { cudaFree(at); }
    device_memory(const device_memory&) = delete;
    device_memory& operator=(const device_memory&) = delete;
    float* at = nullptr;
};

template <class Function>
bool run_blocks(Function function, std::size_t inputs, std::size_t outputs, std::size_t blocks, const float* in,
                float* out)
{
    const std::size_t in_bytes = blocks * block_rows * inputs * sizeof(float);
    const std::size_t out_bytes = blocks * block_rows * outputs * sizeof(float);
    const device_memory from(in_bytes), to(out_bytes);
    cudaMemcpy(from.at, in, in_bytes, cudaMemcpyHostToDevice);
    function<<<unsigned(blocks), block_rows>>>(from.at, to.at);
    cudaMemcpy(out, to.at, out_bytes, cudaMemcpyDeviceToHost);
    return cudaGetLastError() == cudaSuccess;
}

} // namespace

#define ENTRY(name, ...)                                                  \
    extern "C" __global__ void parity_##name(const float* in, float* out) \
    {                                                                     \
        using kernel_type = decltype(&gnomon::name<float>);               \
        run_row<&gnomon::name<float>>(kernel_type(nullptr), in, out);     \
    }
GNOMON_FOR_EACH_KERNEL(ENTRY)

GNOMON_PARITY_EXPORT const char* parity_device()
{
    static const std::string words = [] {
        cudaDeviceProp properties;
        const cudaError_t error = cudaGetDeviceProperties(&properties, 0);
        return error == cudaSuccess ? std::string("fused ") + properties.name
                                    : std::string("unavailable CUDA: ") + cudaGetErrorString(error);
    }();
    return words.c_str();
}

GNOMON_PARITY_EXPORT bool parity_run(const char* kernel, std::size_t blocks, const float* in, float* out)
{
#define RUN(name, inputs, outputs, ...) \
    if (std::string_view(kernel) == #name) return run_blocks(parity_##name, inputs, outputs, blocks, in, out);
    GNOMON_FOR_EACH_KERNEL(RUN)
    return false;
}
