#include "bias.hpp"

#include <Eigen/Eigenvalues>

#include <limits>

namespace gnomon::derivation {
namespace {

using eigen_spectrum = Eigen::SelfAdjointEigenSolver<small_matrix<wide_real>>;

wide_real dual_norm(const moment_vector& v, norm_kind norm)
{
    return norm == norm_kind::maximum ? v.lpNorm<1>() : v.norm();
}

moment_vector even_moments(const small_vector<wide_real>& even)
{
    moment_vector b = moment_vector::Zero(2 * even.size());
    for (int i = 0; i < even.size(); ++i) b[2 * i + 1] = even[i];
    return b;
}

} // namespace

small_matrix<wide_real> hankel(const moment_vector& b, wide_real b0)
{
    const auto n = b.size() / 2 + 1;
    small_matrix<wide_real> matrix(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) matrix(i, j) = i + j ? b[i + j - 1] : b0;
    return matrix;
}

small_matrix<wide_real> localizing(const moment_vector& b)
{
    const auto half = b.size() / 2;
    return hankel(b).topLeftCorner(half, half) - hankel(b).bottomRightCorner(half, half);
}

coefficient_vector square(const coefficient_vector& q)
{
    coefficient_vector p = coefficient_vector::Zero(2 * q.size() - 1);
    for (int i = 0; i < q.size(); ++i)
        for (int j = 0; j < q.size(); ++j) p[i + j] += q[i] * q[j];
    return p;
}

wide_real stored_space::touching_distance(const coefficient_vector& q, const moment_vector& b, norm_kind norm) const
{
    const coefficient_vector p = square(q);
    return (p[0] + p.tail(b.size()).dot(b)) / dual_norm(gradient(p), norm);
}

coefficient_vector stored_space::touching(const small_matrix<wide_real>& hankel_of_b,
                                          const moment_vector& direction) const
{
    const Eigen::GeneralizedSelfAdjointEigenSolver<small_matrix<wide_real>> spectrum(hankel(inverse_ * direction, 0),
                                                                                     hankel_of_b);
    return spectrum.eigenvectors().col(hankel_of_b.rows() - 1);
}

stored_space::boundary_contact stored_space::contact(const moment_vector& b, norm_kind norm) const
{
    const small_matrix<wide_real> matrix = hankel(b);
    const eigen_spectrum spectrum(matrix);
    if (spectrum.eigenvalues()[0] < 1e-12L) return {spectrum.eigenvalues()[0], spectrum.eigenvectors().col(0)};
    boundary_contact nearest{std::numeric_limits<wide_real>::max(), {}};
    for (unsigned corner = 0; corner < 1u << b.size(); ++corner) {
        moment_vector direction(b.size());
        for (int i = 0; i < b.size(); ++i) direction[i] = corner >> i & 1 ? 1 : -1;
        coefficient_vector q = touching(matrix, direction);
        wide_real distance = touching_distance(q, b, norm);
        while (norm == norm_kind::euclidean) {
            const coefficient_vector next = touching(matrix, gradient(square(q)).normalized());
            const wide_real nearer = touching_distance(next, b, norm);
            if (nearer >= distance) break;
            q = next;
            distance = nearer;
        }
        if (distance < nearest.distance) nearest = {distance, q};
    }
    return nearest;
}

moment_vector stored_space::farthest(norm_kind norm) const
{
    // Unknown are the even moments and the distance. E[p] >= margin * distance:
    const auto half = inverse_.rows() / 2;
    const auto cut = [&](const coefficient_vector& p, wide_real margin) {
        half_space<wide_real> result{small_vector<wide_real>(half + 1), p[0]};
        for (int i = 0; i < half; ++i) result.normal[i] = -p[2 * i + 2];
        result.normal[half] = margin;
        return result;
    };
    const auto most_violated = [&](const small_vector<wide_real>& x) {
        const moment_vector b = even_moments(x.head(half));
        const coefficient_vector p = square(contact(b, norm).polynomial.normalized());
        const auto boundary = cut(p, dual_norm(gradient(p), norm));
        // Depths in [-1, 1]: E[(1 - z^2) s^2] >= 0 (Markov, Lukacs).
        const coefficient_vector s = square(eigen_spectrum(localizing(b)).eigenvectors().col(0));
        coefficient_vector inside = coefficient_vector::Zero(p.size());
        inside.head(s.size()) += s;
        inside.tail(s.size()) -= s;
        const auto support = cut(inside, 0);
        return boundary.violation(x) > support.violation(x) ? boundary : support;
    };
    return even_moments(
        maximize<wide_real>(small_vector<wide_real>::Unit(half + 1, half), most_violated, 1e-16L).head(half));
}

} // namespace gnomon::derivation
