// The derivations against independent knowledge: Chebyshev polynomials, the numbers of the paper, definitions,
// and brute force.
#include "constants.hpp"

#include <gnomon/moments/bias.h>
#include <gnomon/moments/quantization.h>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

using namespace gnomon::derivation;

namespace {

void check_transform(const affine_transform<decimal50>& exact)
{
    // Coefficients of a row are below 25; those above 5 are exact, the others rounded to half a unit in the last place.
    CHECK(range_violation(rounded(exact)) <= 1e-15);
    CHECK(range_violation(exact) <= 1e-19);
    CHECK(inverse_residual(exact) <= 1e-15);
}

/// No replacement of a row raises the determinant, and no climb from random rows ends higher.
void check_optimal(const affine_transform<decimal50>& part)
{
    CHECK(stationarity(part) < 1e-18);
    const search_result search = random_climbs(part.exponents, 10, 7);
    CHECK(search.determinant == doctest::Approx(static_cast<double>(part.determinant())).epsilon(1e-9));
    CHECK(search.hits >= 5);
}

/// The least touching distance over all products of `factors` and q whose roots are tan(angle), infinity included.
wide_real brute_force_distance(const stored_space& space, const moment_vector& b, norm_kind norm, int steps,
                               const coefficient_vector& q, int factors, int first = 0)
{
    if (factors == 0) return space.touching_distance(q, b, norm);
    wide_real least = std::numeric_limits<wide_real>::max();
    for (int i = first; i < steps; ++i) {
        const wide_real angle =
            std::numbers::pi_v<wide_real> * static_cast<wide_real>(i) / static_cast<wide_real>(steps);
        coefficient_vector product = coefficient_vector::Zero(q.size() + 1);
        product.head(q.size()) -= std::sin(angle) * q;
        product.tail(q.size()) += std::cos(angle) * q;
        least = std::min(least, brute_force_distance(space, b, norm, steps, product, factors - 1, i));
    }
    return least;
}

wide_real least_eigenvalue(const small_matrix<wide_real>& matrix)
{
    return Eigen::SelfAdjointEigenSolver<small_matrix<wide_real>>(matrix).eigenvalues()[0];
}

/// The least eigenvalue of a Hankel matrix at the corners of the cube around b.
wide_real least_eigenvalue(const stored_space& space, const moment_vector& b, wide_real radius)
{
    wide_real least = 1;
    for (unsigned corner = 0; corner < 1u << b.size(); ++corner) {
        moment_vector step(b.size());
        for (int i = 0; i < b.size(); ++i) step[i] = corner >> i & 1 ? radius : -radius;
        least = std::min(least, least_eigenvalue(hankel(space.moved(b, step))));
    }
    return least;
}

/// True if depths in [-1, 1] have the moments b, up to slack.
bool inside(const moment_vector& b, wide_real slack)
{
    return least_eigenvalue(hankel(b)) >= -slack && least_eigenvalue(localizing(b)) >= -slack;
}

void check_bias(const bias_vector_set& vectors)
{
    CAPTURE(vectors.stored);
    const stored_space space(vectors.transform);
    for (const bias_vector& vector : {vectors.printed, vectors.farthest_euclidean, vectors.farthest}) {
        const moment_vector b = vector.moments.cast<wide_real>();
        const auto radius = static_cast<wide_real>(vector.maximum_norm);
        CHECK(inside(b, 1e-15L));
        // The cube is valid, because its corners are, and touches the boundary.
        CHECK(least_eigenvalue(space, b, radius * (1 - 1e-9L)) > 0);
        CHECK(least_eigenvalue(space, b, radius * (1 + 1e-9L)) < 0);
        // A grid with angles half a degree (2 degrees) apart finds no nearer polynomial, but one almost as near, since
        // the minimum is flat.
        const int steps = b.size() == 4 ? 360 : 90;
        for (const auto& [norm, distance] :
             {std::pair{norm_kind::maximum, vector.maximum_norm}, std::pair{norm_kind::euclidean, vector.euclidean}}) {
            const wide_real brute = brute_force_distance(space, b, norm, steps, coefficient_vector::Ones(1),
                                                         static_cast<int>(b.size()) / 2);
            CHECK(brute >= distance * (1 - 1e-12));
            CHECK(brute <= distance * (b.size() == 4 ? 1.01 : 1.05));
        }
    }
    CHECK(vectors.farthest.maximum_norm >= vectors.printed.maximum_norm);
    CHECK(vectors.farthest.maximum_norm >= vectors.farthest_euclidean.maximum_norm);
    CHECK(vectors.farthest_euclidean.euclidean >= vectors.farthest.euclidean);
    // The distance is concave on a convex set, so a local maximum is the maximum.
    std::mt19937 generator(3);
    std::normal_distribution<wide_real> normal;
    std::uniform_real_distribution<wide_real> exponent(-6, -1);
    int inside_steps = 0;
    for (int i = 0; i < 1000; ++i) {
        moment_vector b = vectors.farthest.moments.cast<wide_real>();
        const wide_real length = std::pow(10.0L, exponent(generator));
        for (wide_real& moment : b) moment += length * normal(generator);
        if (!inside(b, 0)) continue;
        ++inside_steps;
        CHECK(static_cast<double>(space.contact(b, norm_kind::maximum).distance) <=
              vectors.farthest.maximum_norm * (1 + 1e-12));
    }
    CHECK(inside_steps > 20);
}

small_vector<decimal50> row_of(std::initializer_list<double> values)
{
    small_vector<decimal50> row(std::ssize(values));
    std::copy(values.begin(), values.end(), row.begin());
    return row;
}

} // namespace

TEST_CASE("exchange: of all polynomials within [0, 1], Chebyshev's grow fastest")
{
    // T5 = 16 z^5 - 20 z^3 + 5 z, halved to fit, has the largest coefficient of z^5 and is largest beyond [-1, 1].
    for (const auto& objective : {row_of({0, 0, 1}), row_of({2, 8, 32}), row_of({3, 27, 243})}) {
        const auto row = best_row<decimal50>({1, 3, 5}, objective, decimal50(1e-40));
        CHECK((row - row_of({0.5, 2.5, -10, 8})).norm() < 1e-30);
    }
    const auto row = best_row<decimal50>({1, 2, 3, 4}, row_of({0, 0, 0, 1}), decimal50(1e-40));
    CHECK((row - row_of({1, 0, -4, 0, 4})).norm() < 1e-15); // (T4 + 1) / 2
}

TEST_CASE("signed depth: determinant 1024 for four moments, and moments of a depth map to moments of its signed depth")
{
    CHECK(signed_depth(4).determinant() == doctest::Approx(1024));
    small_vector<wide_real> unit(5), expected(5);
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

TEST_CASE("Theta6*: optimal, near the printed digits and better")
{
    const auto odd = odd6(), even = even6();
    check_transform(join(odd, even));
    check_optimal(odd);
    check_optimal(even);
    const auto printed = join(printed_odd6(), printed_even6());
    CHECK(entropy_gain(join(odd, even)) > entropy_gain(printed));
    CHECK(std::round(entropy_gain(join(odd, even)) * 100) == 1251); // 12.5 bits in Sec. 5.4.3
    const auto apart = (join(odd, even).matrix - printed.matrix).lpNorm<Eigen::Infinity>();
    CHECK(apart > 4.5e-3);
    CHECK(apart < 5e-3);
    CHECK(range_violation(printed) > 5.5e-9);
    CHECK(range_violation(printed) < 6.5e-9);
}

TEST_CASE("dense transforms gain little over Theta4*: 4.28 bits, as in Sec. 2.4")
{
    const search_result dense = random_climbs({1, 2, 3, 4}, 40, 1);
    CHECK(std::round(entropy_gain({1, 2, 3, 4}, dense.determinant) * 100) == 428);
    CHECK(dense.hits >= 2);
}

TEST_CASE("bias vectors: distances by definition and by brute force, optimal among their neighbours")
{
    const auto vectors = bias_vectors();
    for (const bias_vector_set& v : vectors) check_bias(v);
    // The paper searched by the Euclidean distance, which is sqrt(2) / 8 without a transform.
    CHECK(vectors[0].printed.euclidean == doctest::Approx(std::sqrt(2.0) / 8).epsilon(1e-12));
    CHECK(vectors[0].farthest_euclidean.euclidean == doctest::Approx(std::sqrt(2.0) / 8).epsilon(1e-12));
    CHECK(vectors[0].farthest_euclidean.moments[1] == doctest::Approx(0.375).epsilon(1e-6));
    CHECK(std::round(vectors[1].farthest_euclidean.moments[1] * 1000) == 628);
}

namespace {

/// Moments or channels from numbers, and the numbers of them.
template <typename Library> Library to_library(const small_vector<wide_real>& v)
{
    const small_vector<double> numbers = v.cast<double>();
    Library b;
    std::memcpy(&b, numbers.data(), sizeof b);
    return b;
}
template <typename Library> small_vector<wide_real> from_library(const Library& b)
{
    small_vector<double> v(static_cast<Eigen::Index>(sizeof b / sizeof(double)));
    std::memcpy(v.data(), &b, sizeof b);
    return v.cast<wide_real>();
}

/// The columns of a kernel's matrix and its offset. Columns are probed with so large a unit that the offset is rounded
/// away, which leaves entries as the kernel has them.
template <typename From, typename To> affine_transform<wide_real> probed(To (*kernel)(From), int m)
{
    const auto image = [&](const small_vector<wide_real>& v) { return from_library(kernel(to_library<From>(v))); };
    affine_transform<wide_real> t{{}, small_matrix<wide_real>(m, m), image(small_vector<wide_real>::Zero(m))};
    constexpr wide_real large = 0x1p100L;
    for (int j = 0; j < m; ++j) t.matrix.col(j) = image(large * small_vector<wide_real>::Unit(m, j)) / large;
    return t;
}

/// Checks that entries are rounded once to double, 2^-53 of their magnitude. A probe of an entry 0 leaves less than 1e-17.
void check_rounded_once(const small_matrix<wide_real>& library, const small_matrix<decimal50>& exact)
{
    for (int i = 0; i < exact.rows(); ++i)
        for (int j = 0; j < exact.cols(); ++j) {
            CAPTURE(i);
            CAPTURE(j);
            const wide_real entry = static_cast<wide_real>(exact(i, j));
            CHECK(std::abs(library(i, j) - entry) <= std::ldexp(std::abs(entry), -53) + 1e-17L);
        }
}

template <typename Moments, typename Channels>
void check_library_transform(const affine_transform<decimal50>& exact, Channels (*forward)(Moments),
                             Moments (*inverse)(Channels))
{
    const int m = exact.size();
    const affine_transform<wide_real> to = probed(forward, m), from = probed(inverse, m);
    check_rounded_once(to.matrix, exact.matrix);
    check_rounded_once(to.offset, exact.offset);
    check_rounded_once(from.matrix, exact.matrix.inverse());
    CHECK((from.matrix * to.offset + from.offset).lpNorm<Eigen::Infinity>() <= 4e-16L); // of offsets in double
}

/// Checks that the vector is the farthest one: equal to the digits that a flat maximum determines, at
/// the full distance.
void check_library_bias(const bias_vector_set& derived, std::initializer_list<double> even)
{
    CAPTURE(derived.stored);
    moment_vector b = moment_vector::Zero(2 * std::ssize(even));
    for (int i = -1; const double moment : even) b[i += 2] = static_cast<wide_real>(moment);
    CHECK((b - derived.farthest.moments.cast<wide_real>()).lpNorm<Eigen::Infinity>() <= 1e-9L);
    const auto contact = stored_space(derived.transform).contact(b, norm_kind::maximum);
    CHECK(static_cast<double>(contact.distance) == doctest::Approx(derived.farthest.maximum_norm).epsilon(1e-11));
}

} // namespace

TEST_CASE("library: the transforms are the derived ones, rounded once")
{
    check_library_transform(join(odd4(), even4()), gnomon::theta4<double>, gnomon::theta4_inverse<double>);
    check_library_transform(join(odd6(), even6()), gnomon::theta6<double>, gnomon::theta6_inverse<double>);
}

TEST_CASE("library: the bias vectors are the farthest, and every bias weight covers its roundings")
{
    const auto vectors = bias_vectors();
    check_library_bias(vectors[0], {gnomon::bias4_raw_b2, gnomon::bias4_raw_b4});
    check_library_bias(vectors[1], {gnomon::bias4_theta_b2, gnomon::bias4_theta_b4});
    check_library_bias(vectors[2], {gnomon::bias6_raw_b2, gnomon::bias6_raw_b4, gnomon::bias6_raw_b6});
    check_library_bias(vectors[3], {gnomon::bias6_theta_b2, gnomon::bias6_theta_b4, gnomon::bias6_theta_b6});
    const auto weight = [all = formats(vectors)](const char* name) {
        const auto format =
            std::find_if(all.begin(), all.end(), [&](const storage_format& f) { return f.name == name; });
        REQUIRE(format != all.end());
        return format->weight();
    };
    // n roundings need n delta / (n delta + r).
    const auto filtered = [&](const char* name) { return 3 * weight(name) / (1 + 3 * weight(name)); };
    CHECK(gnomon::stored4_float_weight >= weight("4 x float"));
    CHECK(gnomon::stored4_half_weight >= weight("4 x half"));
    CHECK(gnomon::stored4_unorm16_weight >= weight("4 x UNORM16"));
    CHECK(gnomon::stored4_float_filtered_weight >= filtered("4 x float"));
    // Passes that truncate count twice.
    CHECK(gnomon::stored4_half_filtered_weight >= 5 * weight("4 x half") / (1 + 5 * weight("4 x half")));
    CHECK(gnomon::stored4_unorm16_filtered_weight >= filtered("4 x UNORM16"));
    CHECK(gnomon::stored6_float_weight >= weight("6 x float"));
    CHECK(gnomon::stored6_unorm16_weight >= weight("6 x UNORM16"));
    CHECK(gnomon::stored6_unorm10_weight >= weight("6 x UNORM10"));
    CHECK(gnomon::stored6_float_filtered_weight >= filtered("6 x float"));
    CHECK(gnomon::stored6_unorm16_filtered_weight >= filtered("6 x UNORM16"));
    CHECK(gnomon::stored6_unorm10_filtered_weight >= filtered("6 x UNORM10"));
}
