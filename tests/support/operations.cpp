// Prints how many operations each kernel of kernels.txt takes: a line per kernel, its name, then the numbers of
// additions and subtractions, multiplications, divisions, square roots, comparisons, selections, and minima and maxima.
#define GNOMON_BENCH_FUSED false // as in GLSL, whatever this processor has
#include "core/operation_count.hpp"
#include "kernels.hpp"

#include <array>
#include <cstdio>
#include <cstring>

namespace gnomon::bench {

/// An argument whose every number counts into total.
template <class T> T counted(operations* total)
{
    std::array<counting_real, sizeof(T) / sizeof(counting_real)> numbers;
    numbers.fill(counting_real(total));
    T value;
    std::memcpy(static_cast<void*>(&value), &numbers, sizeof value);
    return value;
}

template <class Result, class... Arguments> void print_operations(const char* name, Result (*kernel)(Arguments...))
{
    operations o;
    static_cast<void>(kernel(counted<Arguments>(&o)...));
    std::printf("%s %d %d %d %d %d %d %d\n", name, o.additions, o.multiplications, o.divisions, o.roots, o.comparisons,
                o.selections, o.extrema);
}

} // namespace gnomon::bench

int main()
{
#define PRINT(name, ...) gnomon::bench::print_operations(#name, &gnomon::name<gnomon::bench::counting_real>);
    GNOMON_FOR_EACH_KERNEL(PRINT)
}
