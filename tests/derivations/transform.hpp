// Quantization transforms of greatest determinant (Peters et al. 2017, Sec. 2.3, 2.4 and 5.4.3).
//
// A row of the transform is a polynomial f(z) = offset + sum_i coefficient_i z^exponent_i that has to map the depths
// [-1, 1] into [0, 1]. The determinant is linear in each row, so the best row for given other rows is the solution of a
// linear program over z. Improving one row after the other climbs to a fixed point, which satisfies the first-order
// optimality conditions of all rows at once. Random starts search for the highest fixed point.
#pragma once

#include "exchange.hpp"

#include <vector>

namespace gnomon::derivation {

using exponent_list = std::vector<int>;

template <typename Scalar> struct affine_transform {
    exponent_list exponents;
    small_matrix<Scalar> matrix;
    small_vector<Scalar> offset;

    [[nodiscard]] int size() const { return static_cast<int>(exponents.size()); }
    [[nodiscard]] Scalar determinant() const
    {
        using std::abs;
        return abs(matrix.determinant());
    }
};

/// The row (offset, then coefficients) with the largest objective . coefficients that maps [-1, 1] into [0, 1].
template <typename Scalar>
small_vector<Scalar> best_row(const exponent_list& exponents, const small_vector<Scalar>& objective,
                              const Scalar& tolerance);

/// Replaces row after row by the best one until a sweep changes the determinant by a factor below 1 + tolerance. The
/// error of the rows is the square root of the tolerance, since the maximum is flat.
template <typename Scalar> void climb(affine_transform<Scalar>& transform, const Scalar& tolerance);

/// The relative gain of the determinant by the best replacement of a single row: 0 at an optimum.
double stationarity(const affine_transform<decimal50>& transform);

/// The largest distance of the rows from [0, 1] over depths in [-1, 1].
double range_violation(const affine_transform<decimal50>& transform);

/// Bits gained over the naive storage of moments of signed depth, which halves the odd ones to fit them into [0, 1].
double entropy_gain(const exponent_list& exponents, double determinant);
double entropy_gain(const affine_transform<decimal50>& transform);

struct search_result {
    double determinant; // the largest
    int hits;           // climbs that end there
};

/// The best result of climbs from random rows. Climbs that reach a singular matrix are ignored.
search_result random_climbs(const exponent_list& exponents, int starts, unsigned seed);

} // namespace gnomon::derivation
