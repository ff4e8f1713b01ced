// Every kernel of kernels.txt over hostile rows, in float and in double: a line for each with a hash of the bits of its results,
// and how many are outside of [0, 1] where the kernel promises that. targets.py compares the lines of two machines.
#include "kernels.hpp"
#include "support/hostile.hpp"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <tuple>

namespace {

using namespace gnomon;

constexpr int rows = 1500;

template <class T> struct lines {
    test::hostile_source<T> numbers{1};
    std::array<T, 7> next = numbers.draw();
    std::size_t used = 0;
    std::uint64_t hash = 0;
    int outside = 0;

    /// The next numbers as an argument. A row begins with the moments and the receiver of one draw.
    template <class Argument> Argument take()
    {
        T values[sizeof(Argument) / sizeof(T)];
        for (T& x : values) {
            if (used == next.size()) next = numbers.draw(), used = 0;
            x = next[used++];
        }
        Argument argument;
        std::memcpy(&argument, values, sizeof argument);
        return argument;
    }

    template <auto kernel, class Result, class... Arguments> void run_row(Result (*)(Arguments...))
    {
        used = next.size();
        const std::tuple<Arguments...> arguments{take<Arguments>()...}; // braces: left to right
        const Result result = std::apply([](const Arguments&... a) { return kernel(a...); }, arguments);
        T values[sizeof(Result) / sizeof(T)];
        std::memcpy(values, &result, sizeof result);
        for (const T& x : values) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &x, sizeof x);
            if (x != x) bits = ~std::uint64_t{0};
            hash = (hash ^ bits) * 0x100000001b3u;
            hash ^= hash >> 29;
            outside += !(x >= 0 && x <= 1);
        }
    }

    template <auto kernel> void print(const char* name, bool unit)
    {
        hash = 0xcbf29ce484222325u, outside = 0;
        for (int i = 0; i < rows; ++i) run_row<kernel>(kernel);
        std::printf("%s<%d> %016llx %d\n", name, int(8 * sizeof(T)), static_cast<unsigned long long>(hash),
                    unit ? outside : 0);
    }
};

} // namespace

int main()
{
    static lines<float> single;
    static lines<double> twice;
#define PRINT(name, inputs, outputs, families, unit) \
    single.print<&name<float>>(#name, unit);         \
    twice.print<&name<double>>(#name, unit);
    GNOMON_FOR_EACH_KERNEL(PRINT)
}
