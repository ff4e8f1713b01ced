// Quantization transforms of greatest determinant (Peters et al. 2017, sections 2.3, 2.4 and 5.4.3).
//
// A row of the transform is a polynomial f(z) = offset + sum_i coefficient_i z^exponent_i that has to map the depths
// [-1, 1] into [0, 1]. The determinant is linear in each row, so the best row beside given others is a linear program
// over z, and improving one row after the other climbs to a fixed point, which satisfies the first-order optimality
// conditions of all rows at once. Random starts look for the highest fixed point.
#pragma once

#include "exchange.hpp"

#include <vector>

namespace gnomon::derivation {

using Exponents = std::vector<int>;

template <typename Scalar> struct Transform {
    Exponents exponents;
    Matrix<Scalar> matrix;
    Vector<Scalar> offset;

    [[nodiscard]] int size() const { return static_cast<int>(exponents.size()); }
    [[nodiscard]] Scalar determinant() const
    {
        using std::abs;
        return abs(matrix.determinant());
    }
};

/// The row (offset, then coefficients) with the largest objective . coefficients that maps [-1, 1] into [0, 1].
template <typename Scalar>
Vector<Scalar> best_row(const Exponents& exponents, const Vector<Scalar>& objective, const Scalar& tolerance);

/// Replaces row after row by the best one until a sweep changes the determinant by a factor below 1 + tolerance. The
/// rows' error is the square root of the tolerance, for the maximum is flat.
template <typename Scalar> void climb(Transform<Scalar>& transform, const Scalar& tolerance);

/// By which factor, less one, the best replacement of any one row would raise the determinant: 0 at an optimum.
double stationarity(const Transform<Decimal50>& transform);

/// How far the rows leave [0, 1] over the depths [-1, 1].
double range_violation(const Transform<Decimal50>& transform);

/// Bits gained over the naive storage of moments of signed depth, which halves the odd ones to fit them into [0, 1].
double entropy_gain(const Exponents& exponents, double determinant);
double entropy_gain(const Transform<Decimal50>& transform);

struct SearchResult {
    double determinant; // the largest
    int hits;           // climbs that end there
};

/// Climbs from random rows. One that runs into a singular matrix ends nowhere and does not count.
SearchResult random_climbs(const Exponents& exponents, int starts, unsigned seed);

} // namespace gnomon::derivation
