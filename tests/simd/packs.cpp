// Every word of the dialect by every pack, on ordinary and on hostile numbers: the bits of the scalar in every lane.
// A program without doctest, so that it runs on any target and by any version of xsimd. Exit status 1 and a line for each
// word and pack that differs.
#include "alike.hpp"
#include "support/hostile.hpp"

#include <gnomon/numerics/round.h>
#include <gnomon/numerics/two_product.h>
#include <gnomon/simd/wide.hpp>
#if defined(__GLIBCXX__) && !(defined(__clang__) && defined(__AVX512F__))
#include <gnomon/simd/std_simd.hpp>
#endif

#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

int compared = 0, wrong = 0;

/// A third any bits, a third special numbers, a third between -4 and 4.
template <class T> std::vector<T> numbers(std::uint64_t seed)
{
    hostile_source<T> hostile(seed);
    bit_source tame(seed);
    std::vector<T> x(3 << 14);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = i % 3 == 0 ? hostile.pattern() : i % 3 == 1 ? hostile.special() : T(tame.uniform(-4, 4));
    return x;
}

/// Compares a function of two packs with that of their lanes.
template <class Pack> struct comparison {
    using lane = lane_t<Pack>;
    std::string pack;
    std::vector<lane> a = numbers<lane>(1), b = numbers<lane>(2);

    template <class F> void operator()(const char* word, F f) const
    {
        const flushed_denormals flushed;
        std::vector<lane> found(a.size());
        for (std::size_t i = 0; i < a.size(); i += lanes<Pack>())
            store<Pack>(f(load<Pack>(&a[i]), load<Pack>(&b[i])), &found[i]);
        std::size_t differ = 0, last = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (!alike(found[i], f(a[i], b[i]))) ++differ, last = i;
        ++compared, wrong += differ > 0;
        if (differ > 0)
            std::printf("%s, %s: %zu of %zu differ, as %a of %a and %a\n", word, pack.c_str(), differ, a.size(),
                        double(found[last]), double(a[last]), double(b[last]));
    }
};

/// 1 in the lanes where the mask is set, if gnomon_any finds any, and -1 in all others.
template <class Mask, class Real> Real any_lane(Mask mask, Real)
{
    Real result(-1);
    if (gnomon_any(mask)) result = gnomon_select(mask, Real(1), result);
    return result;
}

template <class Pack> void compare(const std::string& origin)
{
    const comparison<Pack> with{origin + " " + real_name<Pack>()};
    const auto one_if = []<class Real>(auto mask, Real) { return gnomon_select(mask, Real(1), Real(-1)); };
    with("+", [](auto a, auto b) { return a + b; });
    with("-", [](auto a, auto b) { return a - b; });
    with("*", [](auto a, auto b) { return a * b; });
    with("/", [](auto a, auto b) { return a / b; });
    with("1 /", []<class Real>(Real a, Real) { return Real(1) / a; });
    with("gnomon_sqrt", [](auto a, auto) { return gnomon_sqrt(a); });
    with("gnomon_abs", [](auto a, auto) { return gnomon_abs(a); });
    with("gnomon_min", [](auto a, auto b) { return gnomon_min(a, b); });
    with("gnomon_max", [](auto a, auto b) { return gnomon_max(a, b); });
    with("<", [&](auto a, auto b) { return one_if(a < b, a); });
    with(">", [&](auto a, auto b) { return one_if(a > b, a); });
    with("<=", [&](auto a, auto b) { return one_if(a <= b, a); });
    with(">=", [&](auto a, auto b) { return one_if(a >= b, a); });
    with("==", [&](auto a, auto b) { return one_if(a == b, a); });
    if constexpr (!requires { typename Pack::arch_type; }) // xsimd 8.1 finds NaN equal to everything here
        with("!=", [&](auto a, auto b) { return one_if(a != b, a); });
    with("&&", [&]<class Real>(Real a, Real b) { return one_if(a < b && b < Real(1), a); });
    with("||", [&]<class Real>(Real a, Real b) { return one_if(a < b || b < Real(1), a); });
    with("!", [&](auto a, auto b) { return one_if(!(a < b), a); });
    with("gnomon_select", [](auto a, auto b) { return gnomon_select(a < b, b, a); });
    with("gnomon_any", [](auto a, auto b) { return any_lane(a < b, a); });
    with("gnomon_difference", [](auto a, auto b) { return gnomon_difference(a, b); });
    with("gnomon_product", [](auto a, auto b) { return gnomon_product(a, b); });
    with("gnomon_high_part", [](auto a, auto) { return gnomon_high_part(a); });
    with("two_product", [](auto a, auto b) { return two_product(a, b).low; });
    with("gnomon_power_of_two", []<class Real>(Real a, Real) {
        return gnomon_power_of_two(nearest_integer(gnomon_min(gnomon_max(a, Real(-120)), Real(120))));
    });
}

template <class T> void compare_packs()
{
#if defined(GNOMON_SIMD_XSIMD_HPP)
    const auto of_size = []<std::size_t size> {
        using batch = xsimd::make_sized_batch_t<T, size>;
        if constexpr (!std::is_void_v<batch>) compare<pack<batch>>("xsimd's");
    };
    of_size.template operator()<2>();
    of_size.template operator()<4>();
    of_size.template operator()<8>();
    of_size.template operator()<16>();
    if constexpr (has_batch<T>) compare<wide<pack<xsimd::batch<T>>>>("wide");
#endif
#if defined(GNOMON_SIMD_STD_SIMD_HPP)
    compare<pack<std::experimental::native_simd<T>>>("the standard library's");
    compare<wide<pack<std::experimental::simd<T>>>>("wide, the standard library's");
#endif
}

} // namespace

int main()
{
    compare_packs<float>();
    compare_packs<double>();
    std::printf("%d of %d words and packs differ from scalars\n", wrong, compared);
    return wrong > 0 || compared == 0;
}
