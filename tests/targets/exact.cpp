// What holds under any flag and on any target, as lines of a word, a kernel and the bits of its results:
//     exact   products, differences, rounding to whole numbers, clamps of NaN, intensities of NaN: the same bits everywhere
//     near    elementary functions, whose last digits contraction may change
// Inputs are made of integers, so that no flag changes them. flags.py and targets.py compare the lines of two builds.
// GNOMON_TEST_REAL is a template of reals.hpp in place of the scalar.
#include <gnomon/numerics/exp.h>
#include <gnomon/numerics/trigonometry.h>
#include <gnomon/numerics/two_product.h>
#include <gnomon/storage/moments4.h>

#if defined(GNOMON_TEST_REAL)
#include "support/reals.hpp"
#endif

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <type_traits>

namespace {

using namespace gnomon;

constexpr int rows = 256;

template <class T> using word = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
template <class T> constexpr int fraction_bits = std::numeric_limits<T>::digits - 1;
template <class T> constexpr word<T> exponent_bias = word<T>(std::numeric_limits<T>::max_exponent - 1);
template <class T> constexpr word<T> infinity_bits = (2 * exponent_bias<T> + 1) << fraction_bits<T>;

template <class T> T from_bits(word<T> bits)
{
    T x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

template <class T> word<T> to_bits(T x)
{
    word<T> bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

std::uint64_t random_bits() // SplitMix64
{
    static std::uint64_t state = 0;
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// A number of either sign with an exponent from low to high. A quarter have few bits: their products are exact, their sums
/// tie.
template <class T> T random_number(int low, int high)
{
    word<T> fraction = word<T>(random_bits()) & ((word<T>(1) << fraction_bits<T>)-1);
    if (random_bits() % 4 == 0) fraction &= ~((word<T>(1) << fraction_bits<T> / 2) - 1);
    const word<T> exponent = word<T>(low + int(random_bits() % std::uint64_t(high - low + 1))) + exponent_bias<T>;
    const word<T> sign = word<T>(random_bits() % 2) << (8 * sizeof(T) - 1);
    return from_bits<T>(sign | (exponent << fraction_bits<T>) | fraction);
}

/// Rows of numbers: a and b; c, often near a b, so that the difference cancels; a number in (-1, 1); a NaN.
template <class T> struct inputs {
    T a[rows], b[rows], c[rows], unit[rows], nan[rows];

    inputs()
    {
        for (int i = 0; i < rows; ++i) {
            a[i] = random_number<T>(-20, 20), b[i] = random_number<T>(-20, 20);
            volatile T product = a[i] * b[i];
            c[i] = i % 3 == 0 ? random_number<T>(-20, 20) : from_bits<T>(to_bits<T>(product) + random_bits() % 3);
            unit[i] = random_number<T>(-8, -1);
            nan[i] = from_bits<T>(infinity_bits<T> + 1 + word<T>(random_bits() % 1000));
        }
    }
};

#if defined(GNOMON_TEST_REAL)
template <class T> using real_of = GNOMON_TEST_REAL<T>;
template <class T> constexpr int lanes = int(test::lanes<real_of<T>>());
template <class T> real_of<T> load(const T* from) { return test::load<real_of<T>>(from); }
template <class T> void store(const real_of<T>& x, T* to) { test::store(x, to); }
#else
template <class T> using real_of = T;
template <class T> constexpr int lanes = 1;
template <class T> T load(const T* from) { return *from; }
template <class T> void store(const T& x, T* to) { *to = x; }
#endif

/// Prints the bits of a kernel's results, a struct of so many numbers for each row.
template <class T, int numbers, class Kernel> void print(const char* kind, const char* name, Kernel kernel)
{
    static T results[numbers][rows];
    for (int i = 0; i < rows; i += lanes<T>) {
        const auto result = kernel(i);
        real_of<T> r[numbers];
        static_assert(sizeof result == sizeof r);
        std::memcpy(static_cast<void*>(r), &result, sizeof r);
        for (int j = 0; j < numbers; ++j) store<T>(r[j], results[j] + i);
    }
    std::printf("%s %s<%d>", kind, name, int(8 * sizeof(T)));
    for (const auto& column : results)
        for (const T& x : column) {
            const word<T> bits = to_bits(x);
            const bool is_nan = (bits & (~word<T>(0) >> 1)) > infinity_bits<T>;
            std::printf(" %llx", static_cast<unsigned long long>(is_nan ? ~word<T>(0) : bits));
        }
    std::printf("\n");
}

template <class T> void print_all()
{
    using Real = real_of<T>;
    static const inputs<T> in;
    const auto a = [](int i) { return load(in.a + i); };
    const auto b = [](int i) { return load(in.b + i); };
    const auto c = [](int i) { return load(in.c + i); };
    const auto unit = [](int i) { return load(in.unit + i); };
    const auto nan = [](int i) { return load(in.nan + i); };
    const Real one = Real(T(1)), minus_one = Real(T(-1));
#define PRINT(kind, numbers, name, ...) print<T, numbers>(#kind, #name, [&](int i) { return name(__VA_ARGS__); })
    PRINT(exact, 2, two_product, a(i), b(i));
    PRINT(exact, 2, two_difference, a(i), b(i));
    PRINT(exact, 2, two_difference_ordered, c(i), gnomon_product(a(i), b(i)));
    PRINT(exact, 2, subtract_product, c(i), a(i), b(i));
    PRINT(exact, 2, subtract_product_ordered, c(i), a(i), b(i));
    PRINT(exact, 1, subtract_product_rounded, c(i), a(i), b(i));
    print<T, 1>("exact", "gnomon_product", [&](int i) { return c(i) - gnomon_product(a(i), b(i)); });
    PRINT(exact, 1, nearest_integer, a(i));
    PRINT(exact, 1, gnomon_power_of_two, nearest_integer(unit(i) * Real(T(100))));
    PRINT(exact, 1, clamp_or_nan, a(i), minus_one, one);
    PRINT(exact, 1, clamp_or_nan, nan(i), minus_one, one);
    PRINT(exact, 1, clamp_or_high, nan(i), minus_one, one);
    PRINT(exact, 1, saturate_or_zero, a(i));
    PRINT(exact, 1, saturate_or_zero, nan(i));
    PRINT(exact, 1, moments4_float_intensity, channels4<Real>{unit(i), nan(i), unit(i), unit(i)}, unit(i));
    PRINT(exact, 1, moments4_unorm16_intensity, channels4<Real>{nan(i), nan(i), nan(i), nan(i)}, unit(i));
    PRINT(near, 1, polynomial_exp, unit(i));
    PRINT(near, 1, polynomial_log, gnomon_abs(a(i)));
    PRINT(near, 1, polynomial_cos, unit(i) * Real(T(100)));
    PRINT(near, 1, polynomial_sin, unit(i) * Real(T(100)));
    PRINT(near, 1, polynomial_atan2, a(i), b(i));
#undef PRINT
}

} // namespace

int main()
{
    print_all<float>();
    print_all<double>();
}
