// Error-free transformations and differences of products against exact arithmetic. Built three times: as users build
// the library, with contraction, which must not change any stated error, and without fused multiply-add, where
// splitting must give the same bits.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/reals.hpp"

#include <gnomon/numerics/two_product.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A type that holds sums and products of two numbers of the domain exactly.
using exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<4096, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

template <class T> exact sum(const double_word<T>& x) { return exact(x.high) + exact(x.low); }

/// A source of numbers of both signs with every exponent from lowest to highest.
template <class T> class magnitudes {
  public:
    magnitudes(std::uint64_t seed, int lowest, int highest) : bits_(seed), lowest_(lowest), highest_(highest) {}
    T operator()()
    {
        // Fractions of few and of many bits: few bits give ties and cancellation.
        const int digits = 1 + int(bits_.below(std::numeric_limits<T>::digits));
        const auto fraction = std::uint64_t{1} << (digits - 1) | (bits_() >> (64 - digits) >> 1);
        const int exponent = lowest_ + int(bits_.below(std::size_t(highest_ - lowest_ + 1)));
        const T x = std::ldexp(T(fraction), exponent - digits + 1);
        return bits_.chance(0.5) ? -x : x;
    }
    bit_source& bits() { return bits_; }

  private:
    bit_source bits_;
    int lowest_, highest_;
};

template <class T> constexpr int domain = std::is_same_v<T, float> ? 100 : 900;
template <class T> const exact unit = ldexp(exact(1), -std::numeric_limits<T>::digits);

/// value rounded to nearest.
template <class T> T nearest(const exact& value) { return value.template convert_to<T>(); }

} // namespace

TEST_CASE_TEMPLATE("the generator of magnitudes has both signs and every exponent", T, float, double)
{
    constexpr int e = domain<T>;
    magnitudes<T> draw(1, -e, e);
    std::vector<int> seen(std::size_t(4 * e + 2));
    for (int i = 0; i < 400 * e; ++i) {
        const T x = draw();
        ++seen[std::size_t(2 * (std::ilogb(x) + e) + (x < 0))];
    }
    CHECK(*std::min_element(seen.begin(), seen.end()) > 10);
}

TEST_CASE_TEMPLATE("two_product is exact, rounds to nearest, and splits to the same bits", T, float, double)
{
    constexpr int e = domain<T> / 2;
    magnitudes<T> draw(2, -e, e);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const T a = draw(), b = draw();
        const double_word<T> p = two_product(a, b);
        const exact product = exact(a) * exact(b);
        REQUIRE(sum(p) == product);
        REQUIRE(p.high == nearest<T>(product));
        REQUIRE(p.low == two_product(plain<T>(a), plain<T>(b)).low.value);
        REQUIRE(p.low == std::fma(a, b, -p.high));
    }
    // The corners of the domain: both factors at one end, or their product at the other.
    for (const int high : {0, domain<T>}) {
        magnitudes<T> first(3, high, high), second(4, -domain<T>, -high + (high == 0 ? domain<T> - 1 : 0));
        for (std::int64_t i = 0; i < effort(10'000); ++i) {
            const T a = first(), b = second();
            REQUIRE(sum(two_product(a, b)) == exact(a) * exact(b));
            REQUIRE(two_product(plain<T>(a), plain<T>(b)).low.value == two_product(a, b).low);
        }
    }
    CHECK(two_product(T(0), T(-3)).high == 0);
    CHECK(two_product(T(0), T(-3)).low == 0);
}

TEST_CASE_TEMPLATE("two_difference is exact in any order, two_difference_ordered for |a| >= |b|", T, float, double)
{
    constexpr int e = domain<T>;
    for (const int spread : {e, 30, 2}) {
        magnitudes<T> draw(5, -spread, spread);
        for (std::int64_t i = 0; i < effort(10'000); ++i) {
            const T a = draw(), b = draw();
            const exact total = exact(a) - exact(b);
            REQUIRE(sum(two_difference(a, b)) == total);
            REQUIRE(two_difference(a, b).high == nearest<T>(total));
            const bool ordered = std::abs(a) >= std::abs(b);
            REQUIRE(sum(ordered ? two_difference_ordered(a, b) : two_difference_ordered(-b, -a)) == total);
            const exact wrong = sum(ordered ? two_difference_ordered(-b, -a) : two_difference_ordered(a, b)) - total;
            REQUIRE(abs(wrong) <= unit<T> * exact(std::max(std::abs(a), std::abs(b))));
        }
    }
}

// Error-free parts matter if c is close to a b.
TEST_CASE_TEMPLATE("differences with products keep their stated errors under cancellation", T, float, double)
{
    magnitudes<T> draw(6, -20, 20);
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const T a = draw(), b = draw();
        const T near_product = a * b * (1 + T(draw.bits().below(5)) * std::numeric_limits<T>::epsilon());
        const T c = draw.bits().chance(0.7) ? near_product : draw();
        const exact difference = exact(c) - exact(a) * exact(b);
        const exact scale = abs(exact(c)) + abs(exact(a) * exact(b));
        REQUIRE(abs(sum(subtract_product(c, a, b)) - difference) <= 2 * unit<T> * unit<T> * scale);
        const exact once = exact(subtract_product_rounded(c, a, b));
        REQUIRE(abs(once - difference) <= (2 * unit<T> + 8 * unit<T> * unit<T>)*abs(difference));
    }
}

TEST_CASE_TEMPLATE("double_word_minor is off by at most 2^-40 of its products in float, 2^-98 in double", T, float,
                   double)
{
    // 2^8 u^2: 2^-40 in float.
    const exact bound = ldexp(exact(1), -40 - 2 * (std::numeric_limits<T>::digits - 24));
    magnitudes<T> draw(7, -12, 12);
    const auto word = [&] {
        double_word<T> x;
        x.high = draw();
        x.low = x.high * draw() * std::numeric_limits<T>::epsilon() * T(0x1p-14);
        return x;
    };
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const double_word<T> a = word(), b = word(), c = word();
        double_word<T> d = word();
        if (draw.bits().chance(0.7))
            d.high = a.high * b.high / c.high, d.low = d.high * std::numeric_limits<T>::epsilon() * T(0.3);
        const exact ab = sum(a) * sum(b), cd = sum(c) * sum(d);
        REQUIRE(abs(sum(double_word_minor(a, b, c, d)) - (ab - cd)) <= bound * (abs(ab) + abs(cd)));
    }
}

TEST_CASE_TEMPLATE("exact products have the same bits for every Real", T, float, double)
{
    constexpr std::size_t block = 64;
    magnitudes<T> draw(8, -domain<T> / 4, domain<T> / 4);
    std::array<std::array<T, block>, 3> in;
    for (std::int64_t i = 0; i < effort(10'000); i += block) {
        for (auto& column : in)
            for (T& x : column) x = draw();
        std::array<std::array<T, block>, 2> expected{}, got{};
        const auto run = [&]<class Real>(auto& out) {
            for (std::size_t k = 0; k < block; k += lanes<Real>()) {
                const Real a = load<Real>(&in[0][k]), b = load<Real>(&in[1][k]), c = load<Real>(&in[2][k]);
                const double_word<Real> p = subtract_product(c, a, b);
                store(p.high, &out[0][k]);
                store(p.low, &out[1][k]);
            }
        };
        run.template operator()<T>(expected);
        for_each_real<T>([&]<class Real> {
            run.template operator()<Real>(got);
            REQUIRE_MESSAGE(std::memcmp(&got, &expected, sizeof got) == 0, real_name<Real>());
        });
    }
}
