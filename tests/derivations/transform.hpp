// Quantization transforms of greatest determinant (Peters et al. 2017, sections 2.3, 2.4 and 5.4.3).
//
// A row of the transform is a polynomial f(z) = offset + sum_i coefficient_i z^exponent_i that has to map the depths
// [-1, 1] into [0, 1]. The determinant is linear in each row, so the best row beside given others is a linear program
// over z, and improving one row after the other climbs to a fixed point, which satisfies the first-order optimality
// conditions of all rows at once. Random starts look for the highest fixed point.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "exchange.hpp"

namespace gnomon::derivation {

template <typename Scalar, int n> struct Transform {
    std::array<int, n> exponents;
    Matrix<Scalar, n> matrix;
    Vector<Scalar, n> offset;

    [[nodiscard]] Scalar determinant() const
    {
        using std::abs;
        return abs(matrix.determinant());
    }

    template <typename Other> [[nodiscard]] Transform<Other, n> cast() const
    {
        return {exponents, matrix.template cast<Other>(), offset.template cast<Other>()};
    }
};

/// One row of a transform: the offset, then the coefficients.
template <typename Scalar, int n> using Row = Vector<Scalar, n + 1>;

template <typename Scalar, int n> Row<Scalar, n> monomials(const std::array<int, n>& exponents, const Scalar& z)
{
    Row<Scalar, n> values;
    values[0] = 1;
    for (int i = 0; i < n; ++i) {
        using std::pow;
        values[i + 1] = pow(z, exponents[i]);
    }
    return values;
}

/// The depth in [-1, 1] where sign * row is greatest: every local maximum on a grid, improved by Newton's iteration on
/// the derivative.
template <typename Scalar, int n>
Scalar extremal_depth(const std::array<int, n>& exponents, const Row<Scalar, n>& row, int sign)
{
    constexpr int intervals = 48;
    const auto value = [&](const Scalar& z) { return Scalar(sign * row.dot(monomials<Scalar, n>(exponents, z))); };
    std::array<Scalar, intervals + 1> depths, values;
    for (int i = 0; i <= intervals; ++i) {
        depths[i] = std::cos(std::numbers::pi * i / intervals);
        values[i] = value(depths[i]);
    }
    Scalar best = depths[0];
    for (int i = 0; i <= intervals; ++i) {
        if ((i > 0 && values[i] < values[i - 1]) || (i < intervals && values[i] < values[i + 1])) continue;
        Scalar z = depths[i];
        for (int step = 0; step < 8; ++step) {
            Scalar slope = 0, curvature = 0;
            for (int k = 0; k < n; ++k) {
                using std::pow;
                const int e = exponents[k];
                slope += row[k + 1] * e * pow(z, e - 1);
                if (e > 1) curvature += row[k + 1] * e * (e - 1) * pow(z, e - 2);
            }
            const Scalar next = z - slope / curvature;
            if (!(next >= -1 && next <= 1 && value(next) >= value(z))) break;
            z = next;
        }
        if (value(z) > value(best)) best = z;
    }
    return best;
}

/// The row with the largest objective . coefficients that maps [-1, 1] into [0, 1].
template <typename Scalar, int n>
Row<Scalar, n> best_row(const std::array<int, n>& exponents, const Vector<Scalar, n>& objective,
                        const Scalar& tolerance)
{
    Row<Scalar, n> lifted;
    lifted << Scalar(0), objective;
    return maximize<Scalar, n + 1>(
        lifted,
        [&](const Row<Scalar, n>& row) {
            const auto bound = [&](int sign) {
                const Scalar z = extremal_depth<Scalar, n>(exponents, row, sign);
                return HalfSpace<Scalar, n + 1>{monomials<Scalar, n>(exponents, z) * Scalar(sign),
                                                Scalar(sign > 0 ? 1 : 0)};
            };
            const auto above = bound(1), below = bound(-1);
            return above.violation(row) > below.violation(row) ? above : below;
        },
        tolerance);
}

/// Replaces row after row by the best one until a sweep raises the determinant by a factor below 1 + tolerance.
/// Returns the number of sweeps. The rows' error is the square root of the tolerance, for the maximum is flat.
template <typename Scalar, int n> int climb(Transform<Scalar, n>& transform, const Scalar& tolerance)
{
    for (int sweep = 1;; ++sweep) {
        Scalar gain = 1;
        for (int i = 0; i < n; ++i) {
            const Vector<Scalar, n> gradient = transform.matrix.inverse().col(i); // of the determinant's logarithm
            const Row<Scalar, n> row = best_row<Scalar, n>(transform.exponents, gradient, tolerance);
            gain *= gradient.dot(row.template tail<n>());
            transform.matrix.row(i) = row.template tail<n>().transpose();
            transform.offset[i] = row[0];
        }
        using std::abs;
        if (abs(gain - 1) < tolerance) return sweep;
    }
}

/// By which factor, less one, the best replacement of any one row would raise the determinant: 0 at an optimum.
template <typename Scalar, int n> Scalar stationarity(const Transform<Scalar, n>& transform)
{
    const Matrix<Scalar, n> gradients = transform.matrix.inverse();
    Scalar gain = 0;
    for (int i = 0; i < n; ++i) {
        const Vector<Scalar, n> gradient = gradients.col(i);
        const auto row = best_row<Scalar, n>(transform.exponents, gradient, Scalar(1e-40));
        gain = std::max<Scalar>(gain, gradient.dot(row.template tail<n>()) - 1);
    }
    return gain;
}

struct SearchResult {
    double best; // determinant
    int hits;    // climbs that end there
};

/// Climbs from random rows. One that runs into a singular matrix ends nowhere and does not count.
template <int n> SearchResult random_climbs(const std::array<int, n>& exponents, int starts, unsigned seed)
{
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    std::vector<double> determinants;
    for (int start = 0; start < starts; ++start) {
        Transform<double, n> t{exponents, Matrix<double, n>::NullaryExpr([&] { return normal(generator); }), {}};
        try {
            climb(t, 1e-11);
            determinants.push_back(t.determinant());
        } catch (const std::runtime_error&) {
        }
    }
    const double best = *std::max_element(determinants.begin(), determinants.end());
    const auto reached = [&](double d) { return d > best * (1 - 1e-8); };
    return {best, static_cast<int>(std::count_if(determinants.begin(), determinants.end(), reached))};
}

} // namespace gnomon::derivation
