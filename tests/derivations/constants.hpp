// What the library stores, derived: the sparse quantization transforms, the bias vectors and the bias weights.
#pragma once

#include <string>

#include "bias.hpp"

namespace gnomon::derivation {

/// Moments of depths in [0, 1] to those in [-1, 1]: z -> 2 z - 1 in equation (2). b_0 = 1 is the first moment of both.
template <int m> Matrix<long double, m + 1> signed_depth()
{
    Matrix<long double, m + 1> matrix = Matrix<long double, m + 1>::Zero();
    for (int j = 0; j <= m; ++j) {
        long double binomial = 1;
        for (int k = 0; k <= j; ++k) {
            matrix(j, k) = binomial * std::pow(2.0L, k) * ((j - k) % 2 ? -1 : 1);
            binomial = binomial * (j - k) / (k + 1);
        }
    }
    return matrix;
}

/// Bits gained over the naive storage of moments of signed depth, which halves the odd ones to fit them into [0, 1].
template <typename Scalar, int n> double entropy_gain(const Transform<Scalar, n>& transform)
{
    int odd = 0;
    for (const int e : transform.exponents) odd += e % 2;
    return std::log2(static_cast<double>(transform.determinant())) + odd;
}

/// Theta4* (equation 3), b1 and b3 apart from b2 and b4. The last row may be any mean of b2 and b4: all have this
/// determinant, and the paper's is the symmetric one.
inline Transform<Decimal50, 2> odd4()
{
    const Decimal50 root3 = sqrt(Decimal50(3)), half = Decimal50(1) / 2;
    Transform<Decimal50, 2> t{{1, 3}, {}, {half, half}};
    t.matrix << 3 * half, -2, root3 / 2, -2 * root3 / 9;
    return t;
}

inline Transform<Decimal50, 2> even4()
{
    const Decimal50 half = Decimal50(1) / 2;
    Transform<Decimal50, 2> t{{2, 4}, {}, {0, 0}};
    t.matrix << 4, -4, half, half;
    return t;
}

/// The even part of Theta6*. In s = 2 z^2 - 1 it is the square beside the odd part of Theta4*, hence closed.
inline Transform<Decimal50, 3> even6()
{
    const Decimal50 root3 = sqrt(Decimal50(3));
    Transform<Decimal50, 3> t{{2, 4, 6}, {}, {0, 0, Decimal50(1) / 2 - 5 * root3 / 18}};
    t.matrix << 4, -4, 0, 9, -24, 16, -root3 / 3, 8 * root3 / 3, -16 * root3 / 9;
    return t;
}

/// The parts of Theta6* as printed in section 5.4.3, transposed as they are meant.
inline Transform<Decimal50, 3> printed_odd6()
{
    const Decimal50 half = Decimal50(1) / 2;
    Transform<Decimal50, 3> t{{1, 3, 5}, {}, {half, half, half}};
    t.matrix << 2.5, -10, 8, -1.87499864, 4.20757543, -1.83257679, 1.26583039, -1.47644883, 0.71061660;
    return t;
}

inline Transform<Decimal50, 3> printed_even6()
{
    Transform<Decimal50, 3> t{{2, 4, 6}, {}, {0, 0, Decimal50("0.018888946")}};
    t.matrix << 4, -4, 0, 9, -24, 16, -0.57759806, 4.61936648, -3.07953907;
    return t;
}

/// The odd part of Theta6*: half the Chebyshev polynomial T5 and two rows without a short closed form. To 20 digits.
inline Transform<Decimal50, 3> odd6()
{
    Transform<Decimal50, 3> t = printed_odd6();
    climb(t, Decimal50("1e-45"));
    const auto rounded = [](const Decimal50& x) { return Decimal50(round(x * Decimal50("1e20")) / Decimal50("1e20")); };
    t.matrix = t.matrix.unaryExpr(rounded).eval();
    t.offset = t.offset.unaryExpr(rounded).eval();
    return t;
}

/// The whole transform of b_1 to b_m from its odd and its even part, in the paper's order of rows: alternating for
/// m = 4, the odd part first for m = 6.
template <typename Scalar, int half>
Transform<Scalar, 2 * half> join(const Transform<Scalar, half>& odd, const Transform<Scalar, half>& even)
{
    constexpr int m = 2 * half;
    Transform<Scalar, m> whole{{}, Matrix<Scalar, m>::Zero(), {}};
    for (int i = 0; i < m; ++i) whole.exponents[i] = i + 1;
    for (int parity = 0; parity < 2; ++parity)
        for (int i = 0; i < half; ++i) {
            const auto& part = parity ? even : odd;
            const int row = m == 4 ? 2 * i + parity : i + half * parity;
            for (int j = 0; j < half; ++j) whole.matrix(row, 2 * j + parity) = part.matrix(i, j);
            whole.offset[row] = part.offset[i];
        }
    return whole;
}

/// How far the rows leave [0, 1] over the depths [-1, 1].
template <typename Scalar, int n> Scalar range_violation(const Transform<Scalar, n>& transform)
{
    Scalar violation = 0;
    for (int i = 0; i < n; ++i)
        for (const int sign : {-1, 1}) {
            Row<Scalar, n> row;
            row << transform.offset[i], transform.matrix.row(i).transpose();
            const Scalar z = extremal_depth<Scalar, n>(transform.exponents, row, sign);
            const Scalar y = row.dot(monomials<Scalar, n>(transform.exponents, z));
            violation = std::max<Scalar>(violation, sign > 0 ? y - 1 : -y);
        }
    return violation;
}

/// A bias vector b_1 to b_m with its distances to the boundary of conv b(R) in stored space.
template <int m> struct BiasVector {
    Vector<double, m> moments;
    double maximum_norm, euclidean;
};

template <int m> struct BiasVectors {
    std::string space; // what is stored
    BiasVector<m> printed, farthest_euclidean, farthest;
};

template <int m>
BiasVectors<m> bias_vectors(std::string space, const Matrix<long double, m>& transform,
                            const Vector<double, m>& printed)
{
    const StoredSpace<long double, m> stored(transform);
    const auto measured = [&](const Vector<double, m>& b) {
        const auto distance = [&](Norm norm) {
            return static_cast<double>(stored.contact(b.template cast<long double>(), norm).distance);
        };
        return BiasVector<m>{b, distance(Norm::maximum), distance(Norm::euclidean)};
    };
    const auto farthest = [&](Norm norm) {
        return measured(stored.farthest(norm, 1e-16L).moments.template cast<double>());
    };
    return {std::move(space), measured(printed), farthest(Norm::euclidean), farthest(Norm::maximum)};
}

inline BiasVectors<4> bias_raw4()
{
    return bias_vectors<4>("b1..b4", Matrix<long double, 4>::Identity(), {0, 0.375, 0, 0.375});
}
inline BiasVectors<4> bias_sparse4()
{
    return bias_vectors<4>("Theta4*", join(odd4(), even4()).matrix.cast<long double>(), {0, 0.628, 0, 0.628});
}
inline const Vector<double, 6> printed_bias6 = {0, 0.5566, 0, 0.489, 0, 0.47869382};
inline BiasVectors<6> bias_raw6()
{
    return bias_vectors<6>("b1..b6", Matrix<long double, 6>::Identity(), printed_bias6);
}
inline BiasVectors<6> bias_sparse6()
{
    return bias_vectors<6>("Theta6*", join(odd6(), even6()).matrix.cast<long double>(), printed_bias6);
}

/// A storage format: the most that one rounding of a stored vector moves a channel, the stored space's distances, and
/// the bias weight of the paper (0 where it has none).
struct Format {
    std::string name;
    double rounding, distance_printed, distance, paper_weight;
};

inline std::vector<Format> formats(const BiasVectors<4>& raw4, const BiasVectors<4>& sparse4,
                                   const BiasVectors<6>& raw6, const BiasVectors<6>& sparse6)
{
    // Half a unit in the last place of [1/2, 1), the coarsest in [-1, 1]; half a step of the fixed-point code.
    const double float32 = std::ldexp(1.0, -25), float16 = std::ldexp(1.0, -12);
    const double unorm16 = 0.5 / 65535, unorm10 = 0.5 / 1023;
    const auto format = [](std::string name, double rounding, const auto& space, double paper_weight) {
        return Format{std::move(name), rounding, space.printed.maximum_norm, space.farthest.maximum_norm, paper_weight};
    };
    return {format("4 x float", float32, raw4, 3e-7),
            format("4 x half", float16, raw4, 0),
            format("4 x half of Theta4*", float16, sparse4, 0),
            format("4 x half of 2 Theta4* - 1", float16 / 2, sparse4, 0),
            format("4 x UNORM16", unorm16, sparse4, 6e-5),
            format("4 x UNORM16, three roundings", 3 * unorm16, sparse4, 6e-5),
            format("6 x float", float32, raw6, 5e-6),
            format("6 x UNORM16", unorm16, sparse6, 8e-5),
            format("6 x UNORM10", unorm10, sparse6, 4e-3),
            format("6 x UNORM10, two roundings", 2 * unorm10, sparse6, 4e-3)};
}

} // namespace gnomon::derivation
