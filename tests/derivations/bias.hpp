// Bias vectors of greatest efficiency in the worst case (Peters et al. 2017, sections 2.5 and 5.4.3).
//
// Storage moves a stored vector by at most delta in every channel. Interpolation by alpha = delta / r towards a vector
// b* whose stored form keeps the distance r, in the maximum norm, from the boundary of all moments conv b(R) makes the
// Hankel matrix of every stored vector definite again; b* has to be a moment vector of depths in [-1, 1].
//
// The distance: moments b are valid if E_b[p] >= 0 for each non-negative polynomial p of degree m; the extreme ones are
// squares p = q^2. One of them touches the ball of radius r around b* at the radius
//     E_b*[q^2] / || Theta^-T coefficients(q^2) ||,                              in the dual norm.
// The maximum norm's ball is a cube, and r is the radius at which its first corner gets a singular Hankel matrix: a
// symmetric eigenvalue problem per corner. For the Euclidean norm, direction and polynomial determine one another in
// turn.
//
// The best b*: the distance is concave and invariant under reflection, so odd moments are zero; each q bounds the
// distance from above linearly, which makes it a linear program over q.
#pragma once

#include "exchange.hpp"

namespace gnomon::derivation {

enum class Norm { euclidean, maximum };

using Real = long double;
using Moments = Vector<Real>;    // b_1 to b_m, or the coefficients 1 to m of a polynomial
using Polynomial = Vector<Real>; // coefficients from 0

/// The Hankel matrix of b_0 to b_m.
Matrix<Real> hankel(const Moments& b, Real b0 = 1);

/// Beside the Hankel matrix, this one has to be positive semi-definite for b to come from depths in [-1, 1].
Matrix<Real> localizing(const Moments& b);

Polynomial square(const Polynomial& q);

/// The space that a transform of the moments b_1 to b_m maps to, and distances in it.
class StoredSpace {
  public:
    explicit StoredSpace(const Matrix<Real>& transform) : inverse_(transform.inverse()) {}

    /// Theta^-T applied to the coefficients of a polynomial but the first: its gradient by the stored channels.
    [[nodiscard]] Moments gradient(const Polynomial& p) const { return inverse_.transpose() * p.tail(inverse_.rows()); }

    /// The moments that lie where `step` leads from b in stored space.
    [[nodiscard]] Moments moved(const Moments& b, const Moments& step) const { return b + inverse_ * step; }

    /// The radius at which the half space E[q^2] >= 0 touches the ball around b.
    [[nodiscard]] Real touching_distance(const Polynomial& q, const Moments& b, Norm norm) const;

    /// The distance from b to the boundary of conv b(R), and the polynomial whose square touches there.
    struct Contact {
        Real distance;
        Polynomial polynomial;
    };
    [[nodiscard]] Contact contact(const Moments& b, Norm norm) const;

    /// The moments of depths in [-1, 1] that are farthest from the boundary of conv b(R).
    [[nodiscard]] Moments farthest(Norm norm) const;

  private:
    /// The q whose square is the first to vanish on the way from b against the direction in stored space.
    [[nodiscard]] Polynomial touching(const Matrix<Real>& hankel_of_b, const Moments& direction) const;

    Matrix<Real> inverse_;
};

} // namespace gnomon::derivation
