// Linear programs in a few unknowns and infinitely many constraints, by exchange (Remez 1934; it is the dual simplex
// method with a generated column): solve for the constraints at hand, ask the family for the one violated most, let
// it replace one of them, until none is violated.
#pragma once

#include <Eigen/Dense>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <stdexcept>

namespace gnomon::derivation {

/// 50 decimal digits: a constant that is stationary to second order still comes out to more than 17.
using Decimal50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Small, on the stack, and of one type for all sizes, which compiles much faster than a type for each.
template <typename Scalar> using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, 8, 1>;
template <typename Scalar> using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

/// The half space normal . x <= bound.
template <typename Scalar> struct HalfSpace {
    Vector<Scalar> normal;
    Scalar bound;

    [[nodiscard]] Scalar violation(const Vector<Scalar>& x) const { return normal.dot(x) - bound; }
};

/// The x with the largest objective . x in the intersection of a bounded family of half spaces.
/// `most_violated(x)` returns the half space of the family that x violates most, or satisfies most narrowly.
template <typename Scalar, typename Family>
Vector<Scalar> maximize(const Vector<Scalar>& objective, Family most_violated, const Scalar& tolerance)
{
    const auto n = objective.size();
    // A box that is far too large is a vertex to begin with: its multipliers are the objective's magnitudes.
    Matrix<Scalar> normals = Matrix<Scalar>::Identity(n, n);
    Vector<Scalar> bounds = Vector<Scalar>::Constant(n, Scalar(1000));
    for (int i = 0; i < n; ++i)
        if (objective[i] < 0) normals(i, i) = -1;
    for (int step = 0; step < 1000; ++step) {
        const Eigen::PartialPivLU<Matrix<Scalar>> rows(normals), columns(normals.transpose());
        const Vector<Scalar> x = rows.solve(bounds);
        const HalfSpace<Scalar> entering = most_violated(x);
        if (entering.violation(x) <= tolerance) return x;
        // The half space that leaves keeps every multiplier non-negative.
        const Vector<Scalar> multipliers = columns.solve(objective), change = columns.solve(entering.normal);
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
