// The derivation, against what is known otherwise: Chebyshev polynomials, the paper's numbers, definitions, brute
// force.
#include "constants.hpp"

#include <gnomon/moments/bias.h>
#include <gnomon/moments/quantization.h>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace gnomon::derivation;

namespace {

void check_transform(const Transform<Decimal50>& exact)
{
    // A row's coefficients are below 25, exact where above 5, and rounded to half a unit in the last place otherwise.
    CHECK(range_violation(rounded(exact)) <= 1e-15);
    CHECK(range_violation(exact) <= 1e-19);
    CHECK(inverse_residual(exact) <= 1e-15);
}

/// No replacement of a row raises the determinant, and no climb from random rows ends higher.
void check_optimal(const Transform<Decimal50>& part)
{
    CHECK(stationarity(part) < 1e-18);
    const SearchResult search = random_climbs(part.exponents, 10, 7);
    CHECK(search.determinant == doctest::Approx(static_cast<double>(part.determinant())).epsilon(1e-9));
    CHECK(search.hits >= 5);
}

/// The least touching distance over all products of `factors` and q whose roots are tan(angle), infinity included.
Real brute_force_distance(const StoredSpace& space, const Moments& b, Norm norm, int steps, const Polynomial& q,
                          int factors, int first = 0)
{
    if (factors == 0) return space.touching_distance(q, b, norm);
    Real least = std::numeric_limits<Real>::max();
    for (int i = first; i < steps; ++i) {
        const Real angle = std::numbers::pi_v<Real> * static_cast<Real>(i) / static_cast<Real>(steps);
        Polynomial product = Polynomial::Zero(q.size() + 1);
        product.head(q.size()) -= std::sin(angle) * q;
        product.tail(q.size()) += std::cos(angle) * q;
        least = std::min(least, brute_force_distance(space, b, norm, steps, product, factors - 1, i));
    }
    return least;
}

Real least_eigenvalue(const Matrix<Real>& matrix)
{
    return Eigen::SelfAdjointEigenSolver<Matrix<Real>>(matrix).eigenvalues()[0];
}

/// The least eigenvalue of a Hankel matrix at the corners of the cube around b.
Real least_eigenvalue(const StoredSpace& space, const Moments& b, Real radius)
{
    Real least = 1;
    for (unsigned corner = 0; corner < 1u << b.size(); ++corner) {
        Moments step(b.size());
        for (int i = 0; i < b.size(); ++i) step[i] = corner >> i & 1 ? radius : -radius;
        least = std::min(least, least_eigenvalue(hankel(space.moved(b, step))));
    }
    return least;
}

/// Whether b can come from depths in [-1, 1].
bool inside(const Moments& b, Real slack)
{
    return least_eigenvalue(hankel(b)) >= -slack && least_eigenvalue(localizing(b)) >= -slack;
}

void check_bias(const BiasVectors& vectors)
{
    CAPTURE(vectors.stored);
    const StoredSpace space(vectors.transform);
    for (const BiasVector& vector : {vectors.printed, vectors.farthest_euclidean, vectors.farthest}) {
        const Moments b = vector.moments.cast<Real>();
        const auto radius = static_cast<Real>(vector.maximum_norm);
        CHECK(inside(b, 1e-15L));
        // The cube is valid, because its corners are, and touches the boundary.
        CHECK(least_eigenvalue(space, b, radius * (1 - 1e-9L)) > 0);
        CHECK(least_eigenvalue(space, b, radius * (1 + 1e-9L)) < 0);
        // A grid finds no nearer polynomial, and one almost as near, for the minimum is flat: its angles are half a
        // degree (2 degrees) apart.
        const int steps = b.size() == 4 ? 360 : 90;
        for (const auto& [norm, distance] :
             {std::pair{Norm::maximum, vector.maximum_norm}, std::pair{Norm::euclidean, vector.euclidean}}) {
            const Real brute =
                brute_force_distance(space, b, norm, steps, Polynomial::Ones(1), static_cast<int>(b.size()) / 2);
            CHECK(brute >= distance * (1 - 1e-12));
            CHECK(brute <= distance * (b.size() == 4 ? 1.01 : 1.05));
        }
    }
    CHECK(vectors.farthest.maximum_norm >= vectors.printed.maximum_norm);
    CHECK(vectors.farthest.maximum_norm >= vectors.farthest_euclidean.maximum_norm);
    CHECK(vectors.farthest_euclidean.euclidean >= vectors.farthest.euclidean);
    // The distance is concave on a convex set, so a local maximum is the maximum.
    std::mt19937 generator(3);
    std::normal_distribution<Real> normal;
    std::uniform_real_distribution<Real> exponent(-6, -1);
    int inside_steps = 0;
    for (int i = 0; i < 1000; ++i) {
        Moments b = vectors.farthest.moments.cast<Real>();
        const Real length = std::pow(10.0L, exponent(generator));
        for (Real& moment : b) moment += length * normal(generator);
        if (!inside(b, 0)) continue;
        ++inside_steps;
        CHECK(static_cast<double>(space.contact(b, Norm::maximum).distance) <=
              vectors.farthest.maximum_norm * (1 + 1e-12));
    }
    CHECK(inside_steps > 20);
}

Vector<Decimal50> row_of(std::initializer_list<double> values)
{
    Vector<Decimal50> row(std::ssize(values));
    std::copy(values.begin(), values.end(), row.begin());
    return row;
}

} // namespace

TEST_CASE("exchange: of all polynomials within [0, 1], Chebyshev's grow fastest")
{
    // T5 = 16 z^5 - 20 z^3 + 5 z, halved to fit, has the largest coefficient of z^5 and is largest beyond [-1, 1].
    for (const auto& objective : {row_of({0, 0, 1}), row_of({2, 8, 32}), row_of({3, 27, 243})}) {
        const auto row = best_row<Decimal50>({1, 3, 5}, objective, Decimal50(1e-40));
        CHECK((row - row_of({0.5, 2.5, -10, 8})).norm() < 1e-30);
    }
    const auto row = best_row<Decimal50>({1, 2, 3, 4}, row_of({0, 0, 0, 1}), Decimal50(1e-40));
    CHECK((row - row_of({1, 0, -4, 0, 4})).norm() < 1e-15); // (T4 + 1) / 2
}

TEST_CASE("signed depth: determinant 1024 for four moments, and the moments of a single depth map right")
{
    CHECK(signed_depth(4).determinant() == doctest::Approx(1024));
    Vector<Real> unit(5), expected(5);
    for (int j = 0; j < 5; ++j) {
        unit[j] = std::pow(0.375L, j);
        expected[j] = std::pow(2 * 0.375L - 1, j);
    }
    CHECK((signed_depth(4) * unit - expected).norm() < 1e-17L);
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
    const auto odd = odd6(), even = even6();
    check_transform(join(odd, even));
    check_optimal(odd);
    check_optimal(even);
    const auto printed = join(printed_odd6(), printed_even6());
    CHECK(entropy_gain(join(odd, even)) > entropy_gain(printed));
    CHECK(std::round(entropy_gain(join(odd, even)) * 100) == 1251); // 12.5 bits in section 5.4.3
    const auto apart = (join(odd, even).matrix - printed.matrix).lpNorm<Eigen::Infinity>();
    CHECK(apart > 4.5e-3);
    CHECK(apart < 5e-3);
    CHECK(range_violation(printed) > 5.5e-9);
    CHECK(range_violation(printed) < 6.5e-9);
}

TEST_CASE("dense transforms gain little over Theta4*: 4.28 bits in section 2.4")
{
    const SearchResult dense = random_climbs({1, 2, 3, 4}, 40, 1);
    CHECK(std::round(entropy_gain({1, 2, 3, 4}, dense.determinant) * 100) == 428);
    CHECK(dense.hits >= 2);
}

TEST_CASE("bias vectors: distances by definition and by brute force, optimal among their neighbours")
{
    const auto vectors = bias_vectors();
    for (const BiasVectors& v : vectors) check_bias(v);
    // The paper searched by the Euclidean distance, which is sqrt(2) / 8 without a transform.
    CHECK(vectors[0].printed.euclidean == doctest::Approx(std::sqrt(2.0) / 8).epsilon(1e-12));
    CHECK(vectors[0].farthest_euclidean.euclidean == doctest::Approx(std::sqrt(2.0) / 8).epsilon(1e-12));
    CHECK(vectors[0].farthest_euclidean.moments[1] == doctest::Approx(0.375).epsilon(1e-6));
    CHECK(std::round(vectors[1].farthest_euclidean.moments[1] * 1000) == 628);
}

namespace {

using Library4 = gnomon::moments4<Real>;
using Library6 = gnomon::moments6<Real>;

void to_library(const Vector<Real>& v, Library4& b) { b = {v[0], v[1], v[2], v[3]}; }
void to_library(const Vector<Real>& v, Library6& b) { b = {v[0], v[1], v[2], v[3], v[4], v[5]}; }
Vector<Real> from_library(const Library4& b) { return Eigen::Vector<Real, 4>{b.b1, b.b2, b.b3, b.b4}; }
Vector<Real> from_library(const Library6& b) { return Eigen::Vector<Real, 6>{b.b1, b.b2, b.b3, b.b4, b.b5, b.b6}; }

/// The columns of a kernel's matrix and its offset, computed with more digits than its constants have.
template <typename Library> Transform<Real> probed(Library (*kernel)(Library), int m)
{
    const auto image = [&](const Vector<Real>& v) {
        Library b;
        to_library(v, b);
        return from_library(kernel(b));
    };
    Transform<Real> t{{}, Matrix<Real>(m, m), image(Vector<Real>::Zero(m))};
    for (int j = 0; j < m; ++j) t.matrix.col(j) = image(Vector<Real>::Unit(m, j)) - t.offset;
    return t;
}

/// Entries are rounded once to double, 2^-53 of their magnitude; 1e-17 is what the probe's subtraction leaves.
void check_rounded_once(const Matrix<Real>& library, const Matrix<Decimal50>& exact)
{
    for (int i = 0; i < exact.rows(); ++i)
        for (int j = 0; j < exact.cols(); ++j) {
            CAPTURE(i);
            CAPTURE(j);
            const Real entry = static_cast<Real>(exact(i, j));
            CHECK(std::abs(library(i, j) - entry) <= std::ldexp(std::abs(entry), -53) + 1e-17L);
        }
}

template <typename Library>
void check_library_transform(const Transform<Decimal50>& exact, Library (*forward)(Library),
                             Library (*inverse)(Library))
{
    const int m = exact.size();
    const Transform<Real> to = probed(forward, m), from = probed(inverse, m);
    check_rounded_once(to.matrix, exact.matrix);
    check_rounded_once(to.offset, exact.offset);
    check_rounded_once(from.matrix, exact.matrix.inverse());
    CHECK((from.matrix * to.offset + from.offset).lpNorm<Eigen::Infinity>() <= 1e-18L);
}

/// The vector is the farthest one: the same to the digits that a flat maximum gives, and with its full distance.
void check_library_bias(const BiasVectors& derived, std::initializer_list<double> even)
{
    CAPTURE(derived.stored);
    Moments b = Moments::Zero(2 * std::ssize(even));
    for (int i = -1; const double moment : even) b[i += 2] = static_cast<Real>(moment);
    CHECK((b - derived.farthest.moments.cast<Real>()).lpNorm<Eigen::Infinity>() <= 1e-9L);
    const auto contact = StoredSpace(derived.transform).contact(b, Norm::maximum);
    CHECK(static_cast<double>(contact.distance) == doctest::Approx(derived.farthest.maximum_norm).epsilon(1e-11));
}

} // namespace

TEST_CASE("library: the transforms are the derived ones, rounded once")
{
    check_library_transform<Library4>(join(odd4(), even4()), gnomon::theta4<Real>, gnomon::theta4_inverse<Real>);
    check_library_transform<Library6>(join(odd6(), even6()), gnomon::theta6<Real>, gnomon::theta6_inverse<Real>);
}

TEST_CASE("library: the bias vectors are the farthest, and no bias weight is below what its roundings ask for")
{
    const auto vectors = bias_vectors();
    check_library_bias(vectors[0], {gnomon::bias4_raw_b2, gnomon::bias4_raw_b4});
    check_library_bias(vectors[1], {gnomon::bias4_theta_b2, gnomon::bias4_theta_b4});
    check_library_bias(vectors[2], {gnomon::bias6_raw_b2, gnomon::bias6_raw_b4, gnomon::bias6_raw_b6});
    check_library_bias(vectors[3], {gnomon::bias6_theta_b2, gnomon::bias6_theta_b4, gnomon::bias6_theta_b6});
    const auto weight = [all = formats(vectors)](const char* name) {
        const auto format = std::find_if(all.begin(), all.end(), [&](const Format& f) { return f.name == name; });
        REQUIRE(format != all.end());
        return format->weight();
    };
    // n roundings ask for n delta / (n delta + r).
    const auto filtered = [&](const char* name) { return 3 * weight(name) / (1 + 3 * weight(name)); };
    CHECK(gnomon::stored4_float_weight >= weight("4 x float"));
    CHECK(gnomon::stored4_half_weight >= weight("4 x half"));
    CHECK(gnomon::stored4_unorm16_weight >= weight("4 x UNORM16"));
    CHECK(gnomon::stored4_float_filtered_weight >= filtered("4 x float"));
    CHECK(gnomon::stored4_half_filtered_weight >= filtered("4 x half"));
    CHECK(gnomon::stored4_unorm16_filtered_weight >= filtered("4 x UNORM16"));
    CHECK(gnomon::stored6_float_weight >= weight("6 x float"));
    CHECK(gnomon::stored6_unorm16_weight >= weight("6 x UNORM16"));
    CHECK(gnomon::stored6_unorm10_weight >= weight("6 x UNORM10"));
    CHECK(gnomon::stored6_float_filtered_weight >= filtered("6 x float"));
    CHECK(gnomon::stored6_unorm16_filtered_weight >= filtered("6 x UNORM16"));
    CHECK(gnomon::stored6_unorm10_filtered_weight >= filtered("6 x UNORM10"));
}
