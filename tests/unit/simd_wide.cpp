// A pack of two packs is a Real with the same bits: every kernel family once, hostile values among the inputs.
#include <doctest/doctest.h>

#include <gnomon/gnomon.h>
#include <array>
#include <bit>
#include <cstdint>
#include <gnomon/simd/wide.hpp>
#include <gnomon/simd/xsimd.hpp>
#include <random>

namespace {

using gnomon::wide;
using pack = xsimd::batch<float>;
using double_pack = wide<pack>;
constexpr std::size_t lanes = double_pack::size;
static_assert(gnomon::real<double_pack>);

template <class Kernel> void compare(Kernel kernel)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> depth(-1, 1);
    for (int round = 0; round < 2000; ++round) {
        std::array<std::array<float, lanes>, 7> in{};
        for (std::size_t i = 0; i < lanes; ++i) {
            for (auto& row : in)
                row[i] = round % 3 == 0 ? std::bit_cast<float>(std::uint32_t(random())) : depth(random);
            if (round % 3 == 1)
                for (std::size_t j = 1; j < 6; ++j) in[j][i] = in[j - 1][i] * in[0][i];
        }
        const auto load = [&](std::size_t j) { return double_pack::load_unaligned(in[j].data()); };
        const double_pack out =
            kernel(gnomon::moments6<double_pack>{load(0), load(1), load(2), load(3), load(4), load(5)}, load(6));
        std::array<float, lanes> got{};
        out.store_unaligned(got.data());
        for (std::size_t i = 0; i < lanes; ++i) {
            const float want =
                kernel(gnomon::moments6<float>{in[0][i], in[1][i], in[2][i], in[3][i], in[4][i], in[5][i]}, in[6][i]);
            CHECK(std::bit_cast<std::uint32_t>(got[i]) == std::bit_cast<std::uint32_t>(want));
        }
    }
}

template <class Real> gnomon::moments4<Real> four(gnomon::moments6<Real> b) { return {b.b1, b.b2, b.b3, b.b4}; }

} // namespace

TEST_CASE("four moments")
{
    compare([](auto b, auto z) { return gnomon::hamburger4_lower(gnomon::hankel4_from_float(four(b)), z); });
    compare([](auto b, auto z) {
        return gnomon::hamburger4_distribution(gnomon::hankel4_from_unorm16(four(b)), z).weight1;
    });
}

TEST_CASE("six moments")
{
    compare([](auto b, auto z) { return gnomon::hamburger6_bounds(gnomon::hankel6_from_float(b), z).lower; });
}

TEST_CASE("elementary functions")
{
    compare([](auto b, auto z) {
        return gnomon::saturate_or_zero(gnomon::polynomial_exp(b.b1) + gnomon::polynomial_cos(z));
    });
}
