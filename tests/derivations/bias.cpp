#include "bias.hpp"

#include <Eigen/Eigenvalues>

#include <limits>

namespace gnomon::derivation {
namespace {

using Spectrum = Eigen::SelfAdjointEigenSolver<Matrix<Real>>;

Real dual_norm(const Moments& v, Norm norm) { return norm == Norm::maximum ? v.lpNorm<1>() : v.norm(); }

Moments even_moments(const Vector<Real>& even)
{
    Moments b = Moments::Zero(2 * even.size());
    for (int i = 0; i < even.size(); ++i) b[2 * i + 1] = even[i];
    return b;
}

} // namespace

Matrix<Real> hankel(const Moments& b, Real b0)
{
    const auto n = b.size() / 2 + 1;
    Matrix<Real> matrix(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) matrix(i, j) = i + j ? b[i + j - 1] : b0;
    return matrix;
}

Matrix<Real> localizing(const Moments& b)
{
    const auto half = b.size() / 2;
    return hankel(b).topLeftCorner(half, half) - hankel(b).bottomRightCorner(half, half);
}

Polynomial square(const Polynomial& q)
{
    Polynomial p = Polynomial::Zero(2 * q.size() - 1);
    for (int i = 0; i < q.size(); ++i)
        for (int j = 0; j < q.size(); ++j) p[i + j] += q[i] * q[j];
    return p;
}

Real StoredSpace::touching_distance(const Polynomial& q, const Moments& b, Norm norm) const
{
    const Polynomial p = square(q);
    return (p[0] + p.tail(b.size()).dot(b)) / dual_norm(gradient(p), norm);
}

Polynomial StoredSpace::touching(const Matrix<Real>& hankel_of_b, const Moments& direction) const
{
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix<Real>> spectrum(hankel(inverse_ * direction, 0), hankel_of_b);
    return spectrum.eigenvectors().col(hankel_of_b.rows() - 1);
}

StoredSpace::Contact StoredSpace::contact(const Moments& b, Norm norm) const
{
    const Matrix<Real> matrix = hankel(b);
    const Spectrum spectrum(matrix);
    if (spectrum.eigenvalues()[0] < 1e-12L) return {spectrum.eigenvalues()[0], spectrum.eigenvectors().col(0)};
    Contact nearest{std::numeric_limits<Real>::max(), {}};
    for (unsigned corner = 0; corner < 1u << b.size(); ++corner) {
        Moments direction(b.size());
        for (int i = 0; i < b.size(); ++i) direction[i] = corner >> i & 1 ? 1 : -1;
        Polynomial q = touching(matrix, direction);
        Real distance = touching_distance(q, b, norm);
        while (norm == Norm::euclidean) {
            const Polynomial next = touching(matrix, gradient(square(q)).normalized());
            const Real nearer = touching_distance(next, b, norm);
            if (nearer >= distance) break;
            q = next;
            distance = nearer;
        }
        if (distance < nearest.distance) nearest = {distance, q};
    }
    return nearest;
}

Moments StoredSpace::farthest(Norm norm) const
{
    // Unknown are the even moments and the distance. E[p] >= margin * distance:
    const auto half = inverse_.rows() / 2;
    const auto cut = [&](const Polynomial& p, Real margin) {
        HalfSpace<Real> half_space{Vector<Real>(half + 1), p[0]};
        for (int i = 0; i < half; ++i) half_space.normal[i] = -p[2 * i + 2];
        half_space.normal[half] = margin;
        return half_space;
    };
    const auto most_violated = [&](const Vector<Real>& x) {
        const Moments b = even_moments(x.head(half));
        const Polynomial p = square(contact(b, norm).polynomial.normalized());
        const auto boundary = cut(p, dual_norm(gradient(p), norm));
        // Depths in [-1, 1]: E[(1 - z^2) s^2] >= 0 (Markov, Lukacs).
        const Polynomial s = square(Spectrum(localizing(b)).eigenvectors().col(0));
        Polynomial inside = Polynomial::Zero(p.size());
        inside.head(s.size()) += s;
        inside.tail(s.size()) -= s;
        const auto support = cut(inside, 0);
        return boundary.violation(x) > support.violation(x) ? boundary : support;
    };
    return even_moments(maximize<Real>(Vector<Real>::Unit(half + 1, half), most_violated, 1e-16L).head(half));
}

} // namespace gnomon::derivation
