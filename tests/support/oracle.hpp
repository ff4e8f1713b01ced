// The moment problem in 120 digits, by Algorithm 1 of Peters et al. 2017 as printed (Hankel system, roots, Vandermonde
// system), for m = 4 and m = 6. This route shares nothing with the kernels.
#pragma once

#include "distributions.hpp"

#include <gnomon/moments/moments.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <cstddef>

namespace gnomon::test {

using high = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>, boost::multiprecision::et_off>;

template <std::size_t m> using high_moments = std::array<high, m + 1>;

/// The moments b_0 to b_m of a distribution, exact to the 120th digit, with weights normalised in this precision.
template <std::size_t m> high_moments<m> exact_moments(const distribution& d)
{
    high_moments<m> b{};
    high total = 0;
    for (double w : d.weights) total += w;
    for (std::size_t i = 0; i < d.depths.size(); ++i) {
        high p = high(d.weights[i]) / total;
        for (std::size_t j = 0; j <= m; ++j, p *= d.depths[i]) b[j] += p;
    }
    return b;
}

/// The four moments, rounded to T.
template <class T> moments4<T> rounded(const high_moments<4>& b) { return {T(b[1]), T(b[2]), T(b[3]), T(b[4])}; }

/// The six moments, rounded to T.
template <class T> moments6<T> rounded(const high_moments<6>& b)
{
    return {T(b[1]), T(b[2]), T(b[3]), T(b[4]), T(b[5]), T(b[6])};
}

/// The biased moments (1 - alpha) b + alpha b*, where b* has the given even moments and odd moments of 0.
template <std::size_t m> high_moments<m> biased(high_moments<m> b, const std::array<double, m / 2>& even, double alpha)
{
    for (std::size_t j = 1; j <= m; ++j)
        b[j] = (1 - high(alpha)) * b[j] + (j % 2 == 0 ? alpha * high(even[j / 2 - 1]) : high(0));
    return b;
}

/// The canonical distribution with a node at z_f, and the bounds on the shadow intensity at z_f.
template <std::size_t m> struct oracle_result {
    bool valid = false; ///< the Hankel matrix is positive definite
    std::array<high, m / 2 + 1> depths, weights;
    high lower, upper, weight;
};

namespace detail {

template <std::size_t n> bool solve(std::array<std::array<high, n + 1>, n>& a, std::array<high, n>& x)
{
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t best = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (abs(a[i][k]) > abs(a[best][k])) best = i;
        if (a[best][k] == 0) return false;
        std::swap(a[k], a[best]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const high f = a[i][k] / a[k][k];
            for (std::size_t j = k; j <= n; ++j) a[i][j] -= f * a[k][j];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        x[k] = a[k][n];
        for (std::size_t j = k + 1; j < n; ++j) x[k] -= a[k][j] * x[j];
        x[k] /= a[k][k];
    }
    return true;
}

template <std::size_t m> bool positive_definite(const high_moments<m>& b)
{
    constexpr std::size_t n = m / 2 + 1;
    std::array<std::array<high, n>, n> a;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) a[i][j] = b[i + j];
    for (std::size_t k = 0; k < n; ++k) {
        if (a[k][k] <= high("1e-100")) return false;
        for (std::size_t i = k + 1; i < n; ++i) {
            const high f = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
        }
    }
    return true;
}

/// The roots of q_0 + ... + q_n z^n, all real, by Newton's method with deflation; a quadratic in closed form.
template <std::size_t n> std::array<high, n> real_roots(std::array<high, n + 1> q)
{
    std::array<high, n> z;
    if constexpr (n == 2) {
        const high h = q[1] / 2, r = sqrt(h * h - q[0] * q[2]), t = h < 0 ? r - h : -(h + r);
        z = {t / q[2], t == 0 ? high(0) : q[0] / t};
    } else {
        // A root near infinity is the inverse of a root near 0 of the reversed polynomial.
        const bool reverse = abs(q[0]) > abs(q[n]);
        if (reverse) std::reverse(q.begin(), q.end());
        // Newton's method converges monotonically from a start beyond the largest root.
        std::array<high, n + 1> p = q;
        for (std::size_t k = n; k > 0; --k) {
            high bound = 0;
            for (std::size_t j = 0; j < k; ++j) bound = std::max(bound, high(abs(p[j] / p[k])));
            high x = 1 + bound;
            for (int i = 0; i < 2000; ++i) {
                high f = p[k], df = 0;
                for (std::size_t j = k; j-- > 0;) df = df * x + f, f = f * x + p[j];
                if (df == 0) break;
                const high step = f / df;
                x -= step;
                if (abs(step) <= high("1e-110") * (1 + abs(x))) break;
            }
            z[k - 1] = x;
            for (std::size_t j = k; j-- > 0;) p[j] += p[j + 1] * x;
            for (std::size_t j = 0; j < k; ++j) p[j] = p[j + 1];
        }
        if (reverse)
            for (high& x : z) x = 1 / x;
    }
    return z;
}

} // namespace detail

template <std::size_t m> oracle_result<m> oracle(const high_moments<m>& b, double z_f)
{
    constexpr std::size_t n = m / 2;
    oracle_result<m> r;
    if (!detail::positive_definite<m>(b)) return r;
    std::array<std::array<high, n + 2>, n + 1> a;
    std::array<high, n + 1> q;
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t j = 0; j <= n; ++j) a[i][j] = b[i + j];
        a[i][n + 1] = pow(high(z_f), int(i));
    }
    if (!detail::solve<n + 1>(a, q) || q[n] == 0) return r;
    const auto roots = detail::real_roots<n>(q);
    r.depths[0] = z_f;
    std::copy(roots.begin(), roots.end(), r.depths.begin() + 1);
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t j = 0; j <= n; ++j) a[i][j] = pow(r.depths[j], int(i));
        a[i][n + 1] = b[i];
    }
    if (!detail::solve<n + 1>(a, r.weights)) return r;
    r.weight = r.weights[0];
    for (std::size_t i = 1; i <= n; ++i)
        if (r.depths[i] < z_f) r.lower += r.weights[i];
    r.upper = r.lower + r.weight;
    r.valid = true;
    return r;
}

/// The sharp lower bound for the exact moments of the distribution, without storage or bias: the reference for leaking.
/// Up to m / 2 depths are determined by their moments, so the bound is then Z(z < z_f) itself.
template <std::size_t m> double ideal_lower(const distribution& d, double z_f)
{
    const auto r = oracle<m>(exact_moments<m>(d), z_f);
    return r.valid ? double(r.lower) : d.below(z_f);
}

} // namespace gnomon::test
