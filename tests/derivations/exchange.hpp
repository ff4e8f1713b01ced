// Linear programs in a few unknowns with infinitely many constraints, by exchange (Remez 1934; the dual simplex method
// with generated columns): solve for the current constraints, find the constraint of the family that the solution
// violates most, exchange it for one of the current ones, and repeat until none is violated.
#pragma once

#include <Eigen/Dense>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <stdexcept>

namespace gnomon::derivation {

/// 50 decimal digits: a constant that is stationary to second order still comes out to more than 17.
using decimal50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Small, on the stack, and of one type for all sizes, which compiles much faster than a type for each.
template <typename Scalar> using small_vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, 8, 1>;
template <typename Scalar> using small_matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

/// The half space normal . x <= bound.
template <typename Scalar> struct half_space {
    small_vector<Scalar> normal;
    Scalar bound;

    [[nodiscard]] Scalar violation(const small_vector<Scalar>& x) const { return normal.dot(x) - bound; }
};

/// The x with the largest objective . x in the intersection of a bounded family of half spaces.
/// `most_violated(x)` returns the half space of the family that x violates most, or satisfies most narrowly.
template <typename Scalar, typename Family>
small_vector<Scalar> maximize(const small_vector<Scalar>& objective, Family most_violated, const Scalar& tolerance)
{
    const auto n = objective.size();
    // The start is a vertex of a box that is far too large. Its multipliers are the magnitudes of the objective.
    small_matrix<Scalar> normals = small_matrix<Scalar>::Identity(n, n);
    small_vector<Scalar> bounds = small_vector<Scalar>::Constant(n, Scalar(1000));
    for (int i = 0; i < n; ++i)
        if (objective[i] < 0) normals(i, i) = -1;
    for (int step = 0; step < 1000; ++step) {
        const Eigen::PartialPivLU<small_matrix<Scalar>> rows(normals), columns(normals.transpose());
        const small_vector<Scalar> x = rows.solve(bounds);
        const half_space<Scalar> entering = most_violated(x);
        if (entering.violation(x) <= tolerance) return x;
        // The half space that leaves keeps every multiplier non-negative.
        const small_vector<Scalar> multipliers = columns.solve(objective), change = columns.solve(entering.normal);
        int leaving = -1;
        for (int i = 0; i < n; ++i)
            if (change[i] > tolerance &&
                (leaving < 0 || multipliers[i] * change[leaving] < multipliers[leaving] * change[i]))
                leaving = i;
        if (leaving < 0) throw std::runtime_error("exchange: the half spaces have no common point");
        normals.row(leaving) = entering.normal.transpose();
        bounds[leaving] = entering.bound;
    }
    throw std::runtime_error("exchange: no convergence");
}

} // namespace gnomon::derivation
