// The contract on bad input, and equal bits for every Real: any numbers go through every route of the moment kernels.
// Results are in range and never NaN, and a NaN input gives lit. Packs, and a Real without fused multiply-add, give the
// bits of the scalar.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/reals.hpp"
#include "support/routes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t block = 1024;

/// The inputs or results of a block, one array per number.
template <class T, std::size_t count> using columns = std::array<std::array<T, block>, count>;

template <class Real, class Route>
void run(const Route& route, const columns<lane_t<Real>, route_inputs>& in, auto& out)
{
    for (std::size_t i = 0; i < block; i += lanes<Real>()) {
        route_numbers<Real> x;
        for (std::size_t j = 0; j < route_inputs; ++j) x[j] = load<Real>(&in[j][i]);
        const auto r = route(x);
        for (std::size_t j = 0; j < r.size(); ++j) store(r[j], &out[j][i]);
    }
}

/// True if the contract allows row i of the results.
template <class Route, class T> bool allowed(const columns<T, route_inputs>& in, const auto& out, std::size_t i)
{
    bool ok = true, unknown = Route::intensities > 0 && std::isnan(in[6][i]);
    for (std::size_t j = 0; j < Route::moments; ++j) unknown = unknown || std::isnan(in[j][i]);
    for (std::size_t j = 0; j < Route::intensities; ++j)
        ok = ok && out[j][i] >= 0 && out[j][i] <= 1 && !(unknown && out[j][i] != 0);
    T sum = 0;
    for (std::size_t j = 0; j < Route::depths; ++j) {
        const T depth = out[Route::intensities + j][i];
        const T weight = out[Route::intensities + Route::depths + j][i];
        ok = ok && std::isfinite(depth) && weight >= 0 && weight <= 1 && !(unknown && depth != 1);
        sum += weight;
    }
    return ok && (Route::depths == 0 || std::abs(sum - 1) <= 4 * std::numeric_limits<T>::epsilon());
}

/// True if products without fused multiply-add are exact in row i (two_product.h), away from overflow and underflow.
template <class T> bool split_is_exact(const columns<T, route_inputs>& in, std::size_t i)
{
    return std::all_of(in.begin(), in.end(), [&](const auto& column) {
        const T x = std::abs(column[i]);
        return x == 0 || (x >= T(0x1p-20) && x <= 2);
    });
}

bool same_row(const auto& a, const auto& b, std::size_t i)
{
    for (std::size_t j = 0; j < a.size(); ++j)
        if (std::memcmp(&a[j][i], &b[j][i], sizeof a[j][i]) != 0) return false;
    return true;
}

/// A message to reproduce the case.
template <class Route, class T>
std::string describe(const Route& route, const columns<T, route_inputs>& in, const auto& out, std::size_t i)
{
    std::string text = std::string(route.name) + "(";
    char number[40];
    for (const auto& column : in) std::snprintf(number, sizeof number, "%a ", double(column[i])), text += number;
    text += ") =";
    for (const auto& column : out) std::snprintf(number, sizeof number, " %.9g", double(column[i])), text += number;
    return text;
}

} // namespace

// The widest pack runs on all inputs. The other Reals run on every sixteenth block, where their bits must be equal.
TEST_CASE_TEMPLATE("moment kernels are total, with the same bits for every Real", T, float, double)
{
    using widest = xsimd::batch<T>;
    const std::int64_t blocks = effort(10'000'000) / std::int64_t(block) + 1;
    hostile_source<T> source(42);
    columns<T, route_inputs> in;
    for (std::int64_t k = 0; k < blocks; ++k) {
        for (std::size_t i = 0; i < block; ++i) {
            const auto x = source.draw();
            for (std::size_t j = 0; j < route_inputs; ++j) in[j][i] = x[j];
        }
        for_each_route([&](const auto& route) {
            using Route = std::remove_cvref_t<decltype(route)>;
            static columns<T, Route::intensities + 2 * Route::depths> out, other;
            run<widest>(route, in, out);
            for (std::size_t i = 0; i < block; ++i)
                if (!allowed<Route>(in, out, i)) FAIL(describe(route, in, out, i));
            if (k % 16 != 0) return;
            for_each_real<T>([&]<class Real> {
                if constexpr (!std::is_same_v<Real, widest>) {
                    run<Real>(route, in, other);
                    if (std::memcmp(&out, &other, sizeof out) == 0) return;
                    for (std::size_t i = 0; i < block; ++i) {
                        const bool same_bits = !is_plain<Real> || split_is_exact(in, i);
                        if (same_bits ? !same_row(out, other, i) : !allowed<Route>(in, other, i))
                            FAIL(real_name<Real>() << ": " << describe(route, in, other, i) << " instead of "
                                                   << describe(route, in, out, i));
                    }
                }
            });
        });
    }
}

TEST_CASE_TEMPLATE("bounds give intensities between lower and upper, and over-darkening scales and clamps", T, float,
                   double)
{
    const hamburger_bounds<T> half{T(0.25), T(0.75), T(0.5)};
    CHECK(bounds_intensity(half, T(1)) == T(0.25));
    CHECK(bounds_intensity(half, T(0.5)) == T(0.5));
    CHECK(bounds_intensity(half, T(0)) == T(0.75));
    CHECK(over_darken(T(0.49), T(0.98)) == T(0.49) / T(0.98));
    CHECK(over_darken(T(0.99), T(0.98)) == T(1));
}

TEST_CASE_TEMPLATE("four moments far from any distribution have positive pivots and a node at the receiver", T, float,
                   double)
{
    bit_source bits(9);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto any = [&](int largest) { return T(std::ldexp(bits.uniform(-1, 1), largest - int(bits.below(60)))); };
        const hankel4<T> h = hankel4_from_moments(moments4<T>{any(30), any(30), any(30), any(30)});
        CHECK(h.variance > 0);
        CHECK(h.determinant > 0);
        const hankel4<T> near = hankel4_from_moments(moments4<T>{any(4), any(4), any(4), any(4)});
        const T z_f = T(bits.uniform(-1, 1));
        CHECK(hamburger4_distribution(near, z_f).depth0 == z_f);
    }
    const T lower = hamburger4_lower(hankel4_from_moments(moments4<T>{0, T(1e30), 0, T(1e30)}),
                                     T(0.5)); // overflows to NaN in float
    CHECK((lower >= 0 && lower <= 1));
}
