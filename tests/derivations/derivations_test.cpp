// The derivation, against what is known otherwise: Chebyshev polynomials, the paper's numbers, definitions, brute
// force.
#include <doctest/doctest.h>

#include "constants.hpp"
#include "gnomon/moments/bias.h"
#include "gnomon/moments/quantization.h"
#include "gnomon/moments/stored.h"

using namespace gnomon::derivation;

namespace {

template <int n> void check_transform(const Transform<Decimal50, n>& exact)
{
    const auto stored = exact.template cast<double>().template cast<Decimal50>();
    // The rows' coefficients are below 25, exact above 9, and rounded to half a unit in the last place otherwise.
    CHECK(range_violation(stored) <= 1e-15);
    CHECK(range_violation(exact) <= 1e-19);
    const Matrix<Decimal50, n> inverse =
        exact.matrix.inverse().eval().template cast<double>().template cast<Decimal50>();
    const Matrix<Decimal50, n> residual = inverse * stored.matrix - Matrix<Decimal50, n>::Identity();
    CHECK(residual.template lpNorm<Eigen::Infinity>() <= 1e-15);
}

/// No replacement of a row raises the determinant, and no climb from random rows ends higher.
template <int n> void check_optimal(const Transform<Decimal50, n>& part)
{
    CHECK(stationarity(part) < 1e-18);
    const SearchResult search = random_climbs<n>(part.exponents, 10, 7);
    CHECK(search.best == doctest::Approx(static_cast<double>(part.determinant())).epsilon(1e-9));
    CHECK(search.hits >= 5);
}

/// The least touching distance over all q with real roots tan(angle), infinity included.
template <int m>
double brute_force_distance(const StoredSpace<double, m>& stored, const Vector<double, m>& b, Norm norm, int steps,
                            typename StoredSpace<double, m>::Polynomial q, int degree = 0, int first = 0)
{
    constexpr int half = m / 2;
    if (degree == half) return stored.touching_distance(q, b, norm);
    double least = std::numeric_limits<double>::max();
    for (int i = first; i < steps; ++i) {
        const double angle = std::numbers::pi * i / steps;
        auto next = (-std::sin(angle) * q).eval();
        next.template tail<half>() += std::cos(angle) * q.template head<half>();
        least = std::min(least, brute_force_distance<m>(stored, b, norm, steps, next, degree + 1, i));
    }
    return least;
}

/// At the distance's multiple `scale`, the least eigenvalue of a Hankel matrix over the corners of the cube around b.
template <int m> double least_eigenvalue(const Matrix<double, m>& transform, const Vector<double, m>& b, double radius)
{
    double least = 1;
    for (unsigned corner = 0; corner < 1u << m; ++corner) {
        Vector<double, m> step;
        for (int i = 0; i < m; ++i) step[i] = corner >> i & 1 ? radius : -radius;
        const Vector<double, m> moved = b + transform.inverse() * step;
        const auto hankel = StoredSpace<double, m>::hankel(moved, 1);
        const Eigen::SelfAdjointEigenSolver<std::decay_t<decltype(hankel)>> spectrum(hankel);
        least = std::min(least, spectrum.eigenvalues()[0]);
    }
    return least;
}

template <int m> bool inside(const Vector<double, m>& b, double slack)
{
    using Space = StoredSpace<double, m>;
    return Eigen::SelfAdjointEigenSolver<typename Space::Hankel>(Space::hankel(b, 1)).eigenvalues()[0] >= -slack &&
           Eigen::SelfAdjointEigenSolver<Matrix<double, m / 2>>(Space::localizing(b)).eigenvalues()[0] >= -slack;
}

template <int m> void check_bias(const BiasVectors<m>& vectors, const Matrix<double, m>& transform)
{
    CAPTURE(vectors.space);
    const StoredSpace<double, m> stored(transform);
    const auto one = StoredSpace<double, m>::Polynomial::Unit(0).eval();
    for (const BiasVector<m>& b : {vectors.printed, vectors.farthest_euclidean, vectors.farthest}) {
        // The cube is valid, because its corners are, and touches the boundary.
        CHECK(least_eigenvalue<m>(transform, b.moments, b.maximum_norm * (1 - 1e-9)) > 0);
        CHECK(least_eigenvalue<m>(transform, b.moments, b.maximum_norm * (1 + 1e-9)) < 0);
        // A grid finds no nearer polynomial, and one almost as near: the minimum is flat, the steps are 180 / steps
        // deg.
        for (const auto& [norm, distance] :
             {std::pair{Norm::maximum, b.maximum_norm}, std::pair{Norm::euclidean, b.euclidean}}) {
            const double brute = brute_force_distance<m>(stored, b.moments, norm, m == 4 ? 720 : 180, one);
            CHECK(brute >= distance * (1 - 1e-12));
            CHECK(brute <= distance * 1.02);
        }
        CHECK(inside<m>(b.moments, 1e-12));
    }
    CHECK(vectors.farthest.maximum_norm >= vectors.printed.maximum_norm);
    CHECK(vectors.farthest.maximum_norm >= vectors.farthest_euclidean.maximum_norm);
    CHECK(vectors.farthest_euclidean.euclidean >= vectors.farthest.euclidean);
    // The distance is concave on a convex set, so a local maximum is the maximum. Steps keep within the set.
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> exponent(-6, -1);
    int steps = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto step = Vector<double, m>::NullaryExpr([&] { return normal(generator); }).eval();
        const Vector<double, m> b = vectors.farthest.moments + std::pow(10.0, exponent(generator)) * step;
        if (!inside<m>(b, 0)) continue;
        ++steps;
        CHECK(stored.contact(b, Norm::maximum).distance <= vectors.farthest.maximum_norm * (1 + 1e-12));
    }
    CHECK(steps > 50);
}

} // namespace

TEST_CASE("exchange: of all polynomials within [0, 1], Chebyshev's grow fastest")
{
    // T5 = 16 z^5 - 20 z^3 + 5 z, halved to fit: it has the largest coefficient of z^5, and beyond [-1, 1] it is
    // largest.
    for (const Vector<Decimal50, 3>& objective :
         {Vector<Decimal50, 3>(0, 0, 1), Vector<Decimal50, 3>(2, 8, 32), Vector<Decimal50, 3>(3, 27, 243)}) {
        const auto row = best_row<Decimal50, 3>({1, 3, 5}, objective, Decimal50(1e-40));
        CHECK((row - Vector<Decimal50, 4>(0.5, 2.5, -10, 8)).norm() < 1e-30);
    }
    const auto row = best_row<double, 4>({1, 2, 3, 4}, {0, 0, 0, 1}, 1e-13);
    CHECK((row - Vector<double, 5>(1, 0, -4, 0, 4)).norm() < 1e-9); // (T4 + 1) / 2
}

TEST_CASE("signed depth: determinant 1024 for four moments, and the moments of a single depth map right")
{
    CHECK(signed_depth<4>().determinant() == doctest::Approx(1024));
    Vector<long double, 5> unit, expected;
    for (int j = 0; j < 5; ++j) {
        unit[j] = std::pow(0.375L, j);
        expected[j] = std::pow(2 * 0.375L - 1, j);
    }
    CHECK((signed_depth<4>() * unit - expected).norm() < 1e-17L);
}

TEST_CASE("Theta4*: closed form, optimal among transforms that keep odd and even moments apart")
{
    check_transform(join(odd4(), even4()));
    check_optimal(odd4());
    check_optimal(even4());
    CHECK(entropy_gain(join(odd4(), even4())) == doctest::Approx(std::log2(32 / std::sqrt(3.0)))); // 4.21 bits
}

TEST_CASE("Theta6*: optimal, near the printed digits and better than them")
{
    check_transform(join(odd6(), even6()));
    check_optimal(odd6());
    check_optimal(even6());
    const double gain = entropy_gain(join(odd6(), even6()));
    CHECK(gain > entropy_gain(join(printed_odd6(), printed_even6())));
    CHECK(std::round(gain * 10) == 125); // 12.5 bits in section 5.4.3
    CHECK((odd6().matrix - printed_odd6().matrix).lpNorm<Eigen::Infinity>() < 5e-3);
    CHECK((even6().matrix - printed_even6().matrix).lpNorm<Eigen::Infinity>() < 1e-3);
    CHECK(range_violation(join(printed_odd6(), printed_even6())) > 1e-9);
}

TEST_CASE("dense transforms gain little over Theta4*: 4.28 bits in section 2.4")
{
    const SearchResult dense = random_climbs<4>({1, 2, 3, 4}, 40, 1);
    CHECK(std::round((std::log2(dense.best) + 2) * 100) == 428);
    CHECK(dense.hits >= 2);
}

TEST_CASE("bias vectors: distances by definition and by brute force, optimal among their neighbours")
{
    const auto raw4 = bias_raw4(), sparse4 = bias_sparse4();
    const auto raw6 = bias_raw6(), sparse6 = bias_sparse6();
    check_bias<4>(raw4, Matrix<double, 4>::Identity());
    check_bias<4>(sparse4, join(odd4(), even4()).matrix.cast<double>());
    check_bias<6>(raw6, Matrix<double, 6>::Identity());
    check_bias<6>(sparse6, join(odd6(), even6()).matrix.cast<double>());
    // The paper searched by the Euclidean distance, which is sqrt(2) / 8 without a transform.
    CHECK(raw4.printed.euclidean == doctest::Approx(std::sqrt(2.0) / 8).epsilon(1e-12));
    CHECK(raw4.farthest_euclidean.euclidean == doctest::Approx(raw4.printed.euclidean).epsilon(1e-12));
    CHECK(raw4.farthest_euclidean.moments[1] == doctest::Approx(0.375).epsilon(1e-6));
    CHECK(std::round(sparse4.farthest_euclidean.moments[1] * 1000) == 628);
}

namespace {

template <int m>
using Stored = std::conditional_t<m == 4, gnomon::moments4<long double>, gnomon::moments6<long double>>;

template <int m> Stored<m> stored(const Vector<long double, m>& v)
{
    if constexpr (m == 4) return {v[0], v[1], v[2], v[3]};
    else return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

template <int m> Vector<long double, m> vector(const Stored<m>& s)
{
    if constexpr (m == 4) return {s.b1, s.b2, s.b3, s.b4};
    else return {s.b1, s.b2, s.b3, s.b4, s.b5, s.b6};
}

/// The columns of the library's transform, computed with more digits than its constants have, are the derived ones
/// rounded once to double: 2^-53 of an entry, and as much of the offset where the constant term has one.
template <int m, typename Forward, typename Inverse>
void check_library_transform(const Transform<Decimal50, m>& exact, Forward forward, Inverse inverse)
{
    using Values = Vector<long double, m>;
    const auto matrix = exact.matrix.template cast<long double>().eval();
    const auto matrix_inverse = exact.matrix.inverse().eval().template cast<long double>().eval();
    const Values offset = exact.offset.template cast<long double>();
    const Values stored_offset = vector<m>(forward(stored<m>(Values::Zero())));
    CHECK((stored_offset - offset).template lpNorm<Eigen::Infinity>() <= std::ldexp(1.0L, -54));
    const Values origin = vector<m>(inverse(stored<m>(stored_offset)));
    CHECK(origin.template lpNorm<Eigen::Infinity>() <= 1e-18L);
    for (int j = 0; j < m; ++j) {
        const Values unit = Values::Unit(j);
        const Values column = vector<m>(forward(stored<m>(unit))) - stored_offset;
        const Values inverse_column = vector<m>(inverse(stored<m>(stored_offset + unit)));
        for (int i = 0; i < m; ++i) {
            CAPTURE(i);
            CAPTURE(j);
            CHECK(std::abs(column[i] - matrix(i, j)) <= std::ldexp(std::abs(matrix(i, j)), -53) + 1e-17L);
            CHECK(std::abs(inverse_column[i] - matrix_inverse(i, j)) <=
                  std::ldexp(std::abs(matrix_inverse(i, j)), -53) + 1e-17L);
        }
    }
}

/// The vector is the farthest one: the same to the digits that a flat maximum gives, and with its full distance.
template <int m>
void check_library_bias(const BiasVectors<m>& derived, const Matrix<long double, m>& transform,
                        const Vector<double, m>& library)
{
    CAPTURE(derived.space);
    CHECK((library - derived.farthest.moments).template lpNorm<Eigen::Infinity>() <= 1e-9);
    const auto contact =
        StoredSpace<long double, m>(transform).contact(library.template cast<long double>(), Norm::maximum);
    CHECK(contact.distance == doctest::Approx(derived.farthest.maximum_norm).epsilon(1e-11));
}

} // namespace

TEST_CASE("library: the transforms are the derived ones, rounded once")
{
    check_library_transform<4>(join(odd4(), even4()), gnomon::theta4<long double>, gnomon::theta4_inverse<long double>);
    check_library_transform<6>(join(odd6(), even6()), gnomon::theta6<long double>, gnomon::theta6_inverse<long double>);
}

TEST_CASE("library: the bias vectors are the farthest, and no bias weight is below what one rounding asks for")
{
    const auto raw4 = bias_raw4(), sparse4 = bias_sparse4();
    const auto raw6 = bias_raw6(), sparse6 = bias_sparse6();
    check_library_bias<4>(raw4, Matrix<long double, 4>::Identity(), {0, gnomon::bias4_raw_b2, 0, gnomon::bias4_raw_b4});
    check_library_bias<4>(sparse4, join(odd4(), even4()).matrix.cast<long double>(),
                          {0, gnomon::bias4_theta_b2, 0, gnomon::bias4_theta_b4});
    check_library_bias<6>(raw6, Matrix<long double, 6>::Identity(),
                          {0, gnomon::bias6_raw_b2, 0, gnomon::bias6_raw_b4, 0, gnomon::bias6_raw_b6});
    check_library_bias<6>(sparse6, join(odd6(), even6()).matrix.cast<long double>(),
                          {0, gnomon::bias6_theta_b2, 0, gnomon::bias6_theta_b4, 0, gnomon::bias6_theta_b6});
    const auto weight = [all = formats(raw4, sparse4, raw6, sparse6)](const char* name) {
        const auto format = std::find_if(all.begin(), all.end(), [&](const Format& f) { return f.name == name; });
        REQUIRE(format != all.end());
        return format->rounding / format->distance;
    };
    CHECK(gnomon::stored4_float_weight >= weight("4 x float"));
    CHECK(gnomon::stored4_half_weight >= weight("4 x half"));
    CHECK(gnomon::stored4_unorm16_weight >= weight("4 x UNORM16"));
    CHECK(gnomon::stored6_float_weight >= weight("6 x float"));
    CHECK(gnomon::stored6_unorm16_weight >= weight("6 x UNORM16"));
    CHECK(gnomon::stored6_unorm10_weight >= weight("6 x UNORM10"));
}
