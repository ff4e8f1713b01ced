#include "transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace gnomon::derivation {
namespace {

template <typename Scalar> Scalar power(const Scalar& base, int exponent)
{
    Scalar result = 1;
    for (int i = 0; i < exponent; ++i) result *= base;
    return result;
}

/// The vector of 1 and the monomials of a depth, whose product with a row is the value of the row.
template <typename Scalar> small_vector<Scalar> monomials(const exponent_list& exponents, const Scalar& z)
{
    small_vector<Scalar> values(1 + std::ssize(exponents));
    values[0] = 1;
    for (int i = 1; const int e : exponents) values[i++] = power(z, e);
    return values;
}

/// The depth in [-1, 1] where sign * row is greatest: every local maximum on a grid, improved by Newton's iteration
/// on the derivative.
template <typename Scalar>
Scalar extremal_depth(const exponent_list& exponents, const small_vector<Scalar>& row, int sign)
{
    constexpr int intervals = 48;
    const auto value = [&](const Scalar& z) { return Scalar(sign * row.dot(monomials<Scalar>(exponents, z))); };
    Eigen::Matrix<Scalar, intervals + 1, 1> depths, values;
    for (int i = 0; i <= intervals; ++i) {
        depths[i] = Scalar(std::cos(std::numbers::pi * i / intervals));
        values[i] = value(depths[i]);
    }
    Scalar best = depths[0];
    for (int i = 0; i <= intervals; ++i) {
        if ((i > 0 && values[i] < values[i - 1]) || (i < intervals && values[i] < values[i + 1])) continue;
        Scalar z = depths[i];
        for (int step = 0; step < 8; ++step) {
            Scalar slope = 0, curvature = 0;
            for (int k = 1; const int e : exponents) {
                slope += row[k] * e * power(z, e - 1);
                curvature += row[k++] * e * (e - 1) * power(z, e - 2);
            }
            const Scalar next = z - slope / curvature;
            if (!(next >= -1 && next <= 1 && value(next) >= value(z))) break;
            z = next;
        }
        if (value(z) > value(best)) best = z;
    }
    return best;
}

/// The most violated bound of a row's values: sign * f(z) <= 1 or 0.
template <typename Scalar>
half_space<Scalar> bound(const exponent_list& exponents, const small_vector<Scalar>& row, int sign)
{
    const Scalar z = extremal_depth(exponents, row, sign);
    return {monomials<Scalar>(exponents, z) * Scalar(sign), Scalar(sign > 0 ? 1 : 0)};
}

} // namespace

template <typename Scalar>
small_vector<Scalar> best_row(const exponent_list& exponents, const small_vector<Scalar>& objective,
                              const Scalar& tolerance)
{
    small_vector<Scalar> lifted(objective.size() + 1);
    lifted << Scalar(0), objective;
    const auto most_violated = [&](const small_vector<Scalar>& row) {
        const auto above = bound(exponents, row, 1), below = bound(exponents, row, -1);
        return above.violation(row) > below.violation(row) ? above : below;
    };
    return maximize<Scalar>(lifted, most_violated, tolerance);
}

template <typename Scalar> void climb(affine_transform<Scalar>& transform, const Scalar& tolerance)
{
    const int n = transform.size();
    transform.offset.resize(n);
    for (Scalar gain = 0; gain < 1 - tolerance || gain > 1 + tolerance;) {
        gain = 1;
        for (int i = 0; i < n; ++i) {
            const small_vector<Scalar> gradient = transform.matrix.inverse().col(i); // of the determinant's logarithm
            const small_vector<Scalar> row = best_row(transform.exponents, gradient, tolerance);
            gain *= gradient.dot(row.tail(n));
            transform.matrix.row(i) = row.tail(n).transpose();
            transform.offset[i] = row[0];
        }
    }
}

template small_vector<long double> best_row(const exponent_list&, const small_vector<long double>&, const long double&);
template small_vector<decimal50> best_row(const exponent_list&, const small_vector<decimal50>&, const decimal50&);
template void climb(affine_transform<decimal50>&, const decimal50&);

double stationarity(const affine_transform<decimal50>& transform)
{
    const small_matrix<decimal50> gradients = transform.matrix.inverse();
    decimal50 gain = 0;
    for (int i = 0; i < transform.size(); ++i) {
        const small_vector<decimal50> gradient = gradients.col(i);
        const small_vector<decimal50> row = best_row(transform.exponents, gradient, decimal50(1e-40));
        gain = std::max<decimal50>(gain, gradient.dot(row.tail(transform.size())) - 1);
    }
    return static_cast<double>(gain);
}

double range_violation(const affine_transform<decimal50>& transform)
{
    decimal50 violation = 0;
    for (int i = 0; i < transform.size(); ++i) {
        small_vector<decimal50> row(transform.size() + 1);
        row << transform.offset[i], transform.matrix.row(i).transpose();
        for (const int sign : {-1, 1})
            violation = std::max(violation, bound(transform.exponents, row, sign).violation(row));
    }
    return static_cast<double>(violation);
}

double entropy_gain(const exponent_list& exponents, double determinant)
{
    return std::log2(determinant) +
           static_cast<double>(std::count_if(exponents.begin(), exponents.end(), [](int e) { return e % 2 == 1; }));
}

double entropy_gain(const affine_transform<decimal50>& transform)
{
    return entropy_gain(transform.exponents, static_cast<double>(transform.determinant()));
}

search_result random_climbs(const exponent_list& exponents, int starts, unsigned seed)
{
    const auto n = std::ssize(exponents);
    std::mt19937 generator(seed);
    std::normal_distribution<long double> normal;
    std::vector<double> determinants;
    for (int start = 0; start < starts; ++start) {
        affine_transform<long double> t{exponents, small_matrix<long double>(n, n), {}};
        for (long double& entry : t.matrix.reshaped()) entry = normal(generator);
        try {
            climb(t, 1e-11L);
            determinants.push_back(static_cast<double>(t.determinant()));
        } catch (const std::runtime_error&) {
        }
    }
    const double best = *std::max_element(determinants.begin(), determinants.end());
    const auto reached = [&](double d) { return d > best * (1 - 1e-8); };
    return {best, static_cast<int>(std::count_if(determinants.begin(), determinants.end(), reached))};
}

} // namespace gnomon::derivation
