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

#include <Eigen/Eigenvalues>
#include <vector>

#include "transform.hpp"

namespace gnomon::derivation {

enum class Norm { euclidean, maximum };

/// A transform of the moments b_1 to b_m, prepared for distances in the space that it maps to.
template <typename Scalar, int m> class StoredSpace {
  public:
    static constexpr int half = m / 2;
    using Moments = Vector<Scalar, m>;           // b_1 to b_m, or coefficients 1 to m of a polynomial
    using Polynomial = Vector<Scalar, half + 1>; // q_0 to q_half
    using Hankel = Matrix<Scalar, half + 1>;

    explicit StoredSpace(const Matrix<Scalar, m>& transform) : inverse_(transform.inverse()) {}

    /// The Hankel matrix of b_0 to b_m.
    [[nodiscard]] static Hankel hankel(const Moments& b, const Scalar& b0)
    {
        Hankel matrix;
        for (int i = 0; i <= half; ++i)
            for (int j = 0; j <= half; ++j) matrix(i, j) = i + j ? b[i + j - 1] : b0;
        return matrix;
    }

    /// Beside the Hankel matrix, this one has to be positive semi-definite for b to come from depths in [-1, 1].
    [[nodiscard]] static Matrix<Scalar, half> localizing(const Moments& b)
    {
        const Hankel matrix = hankel(b, 1);
        return matrix.template topLeftCorner<half, half>() - matrix.template bottomRightCorner<half, half>();
    }

    /// Theta^-T applied to the coefficients 1 to m of a polynomial: its gradient by the stored channels.
    [[nodiscard]] Moments gradient(const Moments& coefficients) const { return inverse_.transpose() * coefficients; }

    /// The coefficients 0 to m of q^2.
    [[nodiscard]] static Vector<Scalar, m + 1> square(const Polynomial& q)
    {
        Vector<Scalar, m + 1> p = Vector<Scalar, m + 1>::Zero();
        for (int i = 0; i <= half; ++i)
            for (int j = 0; j <= half; ++j) p[i + j] += q[i] * q[j];
        return p;
    }

    /// The distance from b to the boundary of conv b(R), and the polynomial whose square touches there.
    struct Contact {
        Scalar distance;
        Polynomial polynomial;
    };

    [[nodiscard]] Contact contact(const Moments& b, Norm norm) const
    {
        const Hankel matrix = hankel(b, 1);
        const Eigen::SelfAdjointEigenSolver<Hankel> spectrum(matrix);
        if (spectrum.eigenvalues()[0] < Scalar(1e-12))
            return {spectrum.eigenvalues()[0], spectrum.eigenvectors().col(0)};
        Contact nearest{std::numeric_limits<Scalar>::max(), {}};
        for (unsigned corner = 0; corner < 1u << m; ++corner) {
            Moments direction;
            for (int i = 0; i < m; ++i) direction[i] = corner >> i & 1 ? 1 : -1;
            Polynomial q = touching(matrix, direction);
            Scalar distance = touching_distance(q, b, norm);
            while (norm == Norm::euclidean) {
                const Polynomial next = touching(matrix, gradient(square(q).template tail<m>()).normalized());
                const Scalar nearer = touching_distance(next, b, norm);
                if (nearer >= distance) break;
                q = next;
                distance = nearer;
            }
            if (distance < nearest.distance) nearest = {distance, q};
        }
        return nearest;
    }

    /// The radius at which the half space E[q^2] >= 0 touches the ball around b.
    [[nodiscard]] Scalar touching_distance(const Polynomial& q, const Moments& b, Norm norm) const
    {
        const Vector<Scalar, m + 1> p = square(q);
        return (p[0] + p.template tail<m>().dot(b)) / dual_norm(gradient(p.template tail<m>()), norm);
    }

    struct Optimum {
        Moments moments;
        Scalar distance;
    };

    /// The moments of depths in [-1, 1] that are farthest from the boundary of conv b(R).
    [[nodiscard]] Optimum farthest(Norm norm, const Scalar& tolerance) const
    {
        using Unknowns = Vector<Scalar, half + 1>; // the even moments, then the distance
        const auto cut = [](const Vector<Scalar, m + 1>& p, const Scalar& margin) {
            HalfSpace<Scalar, half + 1> half_space{Unknowns::Zero(), p[0]};
            for (int i = 0; i < half; ++i) half_space.normal[i] = -p[2 * i + 2];
            half_space.normal[half] = margin;
            return half_space;
        };
        const auto most_violated = [&](const Unknowns& x) {
            const Moments b = even_moments(x);
            const Vector<Scalar, m + 1> p = square(contact(b, norm).polynomial.normalized().eval());
            const auto boundary = cut(p, dual_norm(gradient(p.template tail<m>()), norm));
            // Depths in [-1, 1]: E[(1 - z^2) s^2] >= 0 (Markov, Lukacs).
            const Vector<Scalar, half> s =
                Eigen::SelfAdjointEigenSolver<Matrix<Scalar, half>>(localizing(b)).eigenvectors().col(0);
            Vector<Scalar, m + 1> inside = Vector<Scalar, m + 1>::Zero();
            for (int i = 0; i < half; ++i)
                for (int j = 0; j < half; ++j) {
                    inside[i + j] += s[i] * s[j];
                    inside[i + j + 2] -= s[i] * s[j];
                }
            const auto support = cut(inside, 0);
            return boundary.violation(x) > support.violation(x) ? boundary : support;
        };
        const Unknowns x = maximize<Scalar, half + 1>(Unknowns::Unit(half), most_violated, tolerance);
        return {even_moments(x), x[half]};
    }

  private:
    [[nodiscard]] static Moments even_moments(const Vector<Scalar, half + 1>& x)
    {
        Moments b = Moments::Zero();
        for (int i = 0; i < half; ++i) b[2 * i + 1] = x[i];
        return b;
    }

    [[nodiscard]] static Scalar dual_norm(const Moments& v, Norm norm)
    {
        return norm == Norm::maximum ? v.template lpNorm<1>() : v.norm();
    }

    /// The q whose square is the first to vanish on the way from b against the direction in stored space.
    [[nodiscard]] Polynomial touching(const Hankel& matrix, const Moments& direction) const
    {
        const Hankel step = hankel(inverse_ * direction, 0);
        return Eigen::GeneralizedSelfAdjointEigenSolver<Hankel>(step, matrix).eigenvectors().col(half);
    }

    Matrix<Scalar, m> inverse_;
};

} // namespace gnomon::derivation
