// Compiled by calls.py, never run: a function around every kernel for every pack. Operands come from memory and results
// go there, as in a caller's loop; by value, large structs would be copied by memcpy for the calling convention's sake.
#include "kernels.hpp"
#include "pack.hpp"

template <auto kernel, class = decltype(kernel)> struct around;

template <auto kernel, class Result, class... Arguments> struct around<kernel, Result (*)(Arguments...)> {
    static void call(Result* result, const Arguments*... arguments) { *result = kernel(*arguments...); }
};

template <class Real> const void* function(int i)
{
    using namespace gnomon;
#define AROUND(name, ...) reinterpret_cast<const void*>(&around<&name<Real>>::call),
    static const void* const table[] = {GNOMON_FOR_EACH_KERNEL(AROUND)};
    return table[i];
}

#define EMIT(lanes, T) template const void* function<pack<T, lanes>>(int);
FOR_EACH_PACK(EMIT)

// The control: calls.py must find this call, and no other.
double opaque(double x);
double control(double x) { return opaque(x) + 1.0; }
template struct around<&control>;
