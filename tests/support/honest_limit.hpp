// The honest limit: the largest intensity that any method can show for given stored moments without ever darkening a
// surface. By duality it is the largest certificate (certified4.h), found here by a search over both of its nodes.
#pragma once

#include <gnomon/moments/bias.h>
#include <gnomon/moments/hamburger4.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::test {

/// The coefficients p0 to p4.
using quartic = std::array<double, 5>;

/// The mean of p for the stored moments, minus the largest effect of their errors.
template <class Norm> double certified_mean(const quartic& p, const moments4<double>& b, Norm norm)
{
    return p[0] + p[1] * b.b1 + p[2] * b.b2 + p[3] * b.b3 + p[4] * b.b4 - norm(p);
}

/// The certificate with one node at z_f - before and the other at z_f + behind, where a negative `behind` puts
/// both before z_f.
inline quartic certificate_of_nodes(double z_f, double before, double behind)
{
    const double c = 1 / before, g = -1 / behind;
    std::array<double, 3> square{}, other{}; // in y = z - z_f
    double top = 1;
    if (behind > 0) {
        const double k = 1 / (before + behind), t = behind * k;
        square = {t * t, -2 * t * k, k * k};
        other = {0, 2 * (c + k), c * (c + 2 * k)};
        top = 0;
    } else {
        square = {1, 2 * c, c * c};
        other = {1, 2 * g, g * g};
    }
    quartic y{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) y[i + j] -= square[i] * other[j];
    y[0] += top;
    for (std::size_t i = 0; i < 4; ++i) // Taylor's shift, by Horner's rule
        for (std::size_t j = 4; j-- > i;) y[j] -= z_f * y[j + 1];
    return y;
}

/// The largest certified mean for a receiver at z_f, at least 0. norm(p) is the largest effect of storage errors on the
/// mean of p. The search starts from the nodes of b with biases around weight.
template <class Norm> double honest_limit(const moments4<double>& b, double z_f, double bias, double weight, Norm norm)
{
    double best = 0;
    const auto rate = [&](const std::array<double, 2>& x, bool between) {
        const double behind = std::exp(x[1]);
        return certified_mean(certificate_of_nodes(z_f, std::exp(x[0]), between ? behind : -behind), b, norm);
    };
    for (const double scale : {0.2, 1.0, 5.0}) {
        const auto h = hankel4_from_moments(moments4_add_bias(b, bias, bias, scale * weight));
        const auto d = hamburger4_distribution(h, z_f);
        const double y1 = d.depth1 - z_f, y2 = d.depth2 - z_f;
        if (!(y1 < 0)) continue;
        const bool between = y2 > 0;
        std::array<double, 2> x = {std::log(-y1), std::log(std::max(std::abs(y2), 1e-9))};
        double height = rate(x, between);
        for (double step = 0.5; step > 1e-3;) {
            bool moved = false;
            for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}}) {
                const std::array<double, 2> next = {x[0] + step * dx, x[1] + step * dy};
                const double h2 = rate(next, between);
                if (h2 > height) x = next, height = h2, moved = true;
            }
            if (!moved) step /= 2;
        }
        best = std::max(best, height);
    }
    return std::min(best, 1.0);
}

} // namespace gnomon::test
