// Linear programs in a few unknowns and infinitely many constraints, by exchange (Remez 1934; it is the dual simplex
// method with a generated column): solve for the constraints at hand, ask the family for the one violated most, let
// it replace one of them, until none is violated.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <stdexcept>

namespace gnomon::derivation {

/// 50 decimal digits: a constant that is stationary to second order still comes out to more than 17.
using Decimal50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

template <typename Scalar, int n> using Vector = Eigen::Matrix<Scalar, n, 1>;
template <typename Scalar, int n> using Matrix = Eigen::Matrix<Scalar, n, n>;

/// The half space normal . x <= bound.
template <typename Scalar, int n> struct HalfSpace {
    Vector<Scalar, n> normal;
    Scalar bound;

    [[nodiscard]] Scalar violation(const Vector<Scalar, n>& x) const { return normal.dot(x) - bound; }
};

/// The x with the largest objective . x in the intersection of a bounded family of half spaces.
/// `most_violated(x)` returns the half space of the family that x violates most, or satisfies most narrowly.
template <typename Scalar, int n, typename Family>
Vector<Scalar, n> maximize(const Vector<Scalar, n>& objective, Family most_violated, const Scalar& tolerance)
{
    // A box that is far too large is a vertex to begin with: its multipliers are the objective's magnitudes.
    std::array<HalfSpace<Scalar, n>, n> active;
    for (int i = 0; i < n; ++i)
        active[i] = {Vector<Scalar, n>::Unit(i) * Scalar(objective[i] < 0 ? -1 : 1), Scalar(1000)};
    for (int step = 0; step < 1000; ++step) {
        Matrix<Scalar, n> normals;
        Vector<Scalar, n> bounds;
        for (int i = 0; i < n; ++i) {
            normals.row(i) = active[i].normal.transpose();
            bounds[i] = active[i].bound;
        }
        const Eigen::FullPivLU<Matrix<Scalar, n>> rows(normals), columns(normals.transpose());
        const Vector<Scalar, n> x = rows.solve(bounds);
        const HalfSpace<Scalar, n> entering = most_violated(x);
        if (entering.violation(x) <= tolerance) return x;
        // The half space that leaves keeps every multiplier non-negative.
        const Vector<Scalar, n> multipliers = columns.solve(objective), change = columns.solve(entering.normal);
        int leaving = -1;
        for (int i = 0; i < n; ++i)
            if (change[i] > tolerance &&
                (leaving < 0 || multipliers[i] * change[leaving] < multipliers[leaving] * change[i]))
                leaving = i;
        if (leaving < 0) throw std::runtime_error("exchange: the half spaces have no common point");
        active[leaving] = entering;
    }
    throw std::runtime_error("exchange: no convergence");
}

} // namespace gnomon::derivation
