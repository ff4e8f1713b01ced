// Bias vectors of greatest efficiency in the worst case (Peters et al. 2017, Sec. 2.5 and 5.4.3).
//
// Storage moves a stored vector by at most delta in every channel. Interpolation by alpha = delta / r towards a vector
// b* makes the Hankel matrix of every stored vector definite again, where r is the distance in the maximum norm of the
// stored b* from the boundary of all moments conv b(R). b* must have the moments of depths in [-1, 1].
//
// The distance: moments b are valid if E_b[p] >= 0 for each non-negative polynomial p of degree m, of which the extreme
// ones are squares p = q^2. Such a p touches the ball around b* at the radius
//     E_b*[q^2] / || Theta^-T coefficients(q^2) ||,                              in the dual norm.
// The ball of the maximum norm is a cube, and r is the radius at which the Hankel matrix of the first corner becomes
// singular: a symmetric eigenvalue problem for each corner. For the Euclidean norm an iteration alternates between the
// direction and the polynomial.
//
// The best b*: the distance is concave and invariant under reflection, so odd moments are 0. Each q bounds the distance
// from above linearly, so the best b* is the solution of a linear program over q.
#pragma once

#include "exchange.hpp"

namespace gnomon::derivation {

enum class norm_kind { euclidean, maximum };

using wide_real = long double;
using moment_vector = small_vector<wide_real>;      // b_1 to b_m, or the coefficients 1 to m of a polynomial
using coefficient_vector = small_vector<wide_real>; // coefficients from 0

/// The Hankel matrix of b_0 to b_m.
small_matrix<wide_real> hankel(const moment_vector& b, wide_real b0 = 1);

/// The localizing matrix. It and the Hankel matrix are positive semi-definite if and only if depths in [-1, 1] have
/// the moments b.
small_matrix<wide_real> localizing(const moment_vector& b);

coefficient_vector square(const coefficient_vector& q);

/// The image of the moments b_1 to b_m under a transform, and distances there.
class stored_space {
  public:
    explicit stored_space(const small_matrix<wide_real>& transform) : inverse_(transform.inverse()) {}

    /// The gradient of E[p] by the stored channels: Theta^-T times the coefficients of p without the first.
    [[nodiscard]] moment_vector gradient(const coefficient_vector& p) const
    {
        return inverse_.transpose() * p.tail(inverse_.rows());
    }

    /// The moments after a step from b in stored space.
    [[nodiscard]] moment_vector moved(const moment_vector& b, const moment_vector& step) const
    {
        return b + inverse_ * step;
    }

    /// The radius at which the half space E[q^2] >= 0 touches the ball around b.
    [[nodiscard]] wide_real touching_distance(const coefficient_vector& q, const moment_vector& b,
                                              norm_kind norm) const;

    /// The distance from b to the boundary of conv b(R), and the polynomial whose square touches there.
    struct boundary_contact {
        wide_real distance;
        coefficient_vector polynomial;
    };
    [[nodiscard]] boundary_contact contact(const moment_vector& b, norm_kind norm) const;

    /// The moments of depths in [-1, 1] that are farthest from the boundary of conv b(R).
    [[nodiscard]] moment_vector farthest(norm_kind norm) const;

  private:
    /// The q whose square is the first to vanish on the way from b against the direction in stored space.
    [[nodiscard]] coefficient_vector touching(const small_matrix<wide_real>& hankel_of_b,
                                              const moment_vector& direction) const;

    small_matrix<wide_real> inverse_;
};

} // namespace gnomon::derivation
