#include "constants.hpp"

#include <cmath>

namespace gnomon::derivation {
namespace {

const decimal50 root3 = sqrt(decimal50(3)), half = decimal50(1) / 2;

affine_transform<decimal50> transform(const exponent_list& exponents, std::initializer_list<decimal50> entries,
                                      std::initializer_list<decimal50> offsets)
{
    const int n = static_cast<int>(exponents.size());
    affine_transform<decimal50> t{exponents, small_matrix<decimal50>(n, n), small_vector<decimal50>(n)};
    std::copy(entries.begin(), entries.end(), t.matrix.reshaped<Eigen::RowMajor>().begin());
    std::copy(offsets.begin(), offsets.end(), t.offset.begin());
    return t;
}

small_vector<double> moments(std::initializer_list<double> even)
{
    small_vector<double> b = small_vector<double>::Zero(2 * std::ssize(even));
    for (int i = 1; const double moment : even) {
        b[i] = moment;
        i += 2;
    }
    return b;
}

bias_vector_set bias_vectors(std::string stored, const small_matrix<wide_real>& matrix,
                             const small_vector<double>& printed)
{
    const stored_space space(matrix);
    const auto measured = [&](const small_vector<double>& b) {
        const auto distance = [&](norm_kind norm) {
            return static_cast<double>(space.contact(b.cast<wide_real>(), norm).distance);
        };
        return bias_vector{b, distance(norm_kind::maximum), distance(norm_kind::euclidean)};
    };
    return {std::move(stored), matrix, measured(printed), measured(space.farthest(norm_kind::euclidean).cast<double>()),
            measured(space.farthest(norm_kind::maximum).cast<double>())};
}

} // namespace

small_matrix<wide_real> signed_depth(int m)
{
    small_matrix<wide_real> matrix = small_matrix<wide_real>::Zero(m + 1, m + 1);
    for (int j = 0; j <= m; ++j) {
        wide_real binomial = 1;
        for (int k = 0; k <= j; ++k) {
            matrix(j, k) = binomial * std::ldexp(wide_real((j - k) % 2 ? -1 : 1), k);
            binomial = binomial * static_cast<wide_real>(j - k) / static_cast<wide_real>(k + 1);
        }
    }
    return matrix;
}

affine_transform<decimal50> odd4()
{
    return transform({1, 3}, {3 * half, -2, root3 / 2, -2 * root3 / 9}, {half, half});
}

affine_transform<decimal50> even4() { return transform({2, 4}, {4, -4, half, half}, {0, 0}); }

affine_transform<decimal50> odd6()
{
    affine_transform<decimal50> t = printed_odd6();
    climb(t, decimal50("1e-45"));
    const auto twenty_digits = [scale = decimal50("1e20")](const decimal50& x) {
        return decimal50(round(x * scale) / scale);
    };
    t.matrix = t.matrix.unaryExpr(twenty_digits).eval();
    t.offset = t.offset.unaryExpr(twenty_digits).eval();
    return t;
}

affine_transform<decimal50> even6()
{
    return transform({2, 4, 6}, {4, -4, 0, 9, -24, 16, -root3 / 3, 8 * root3 / 3, -16 * root3 / 9},
                     {0, 0, half - 5 * root3 / 18});
}

affine_transform<decimal50> printed_odd6()
{
    return transform({1, 3, 5},
                     {2.5, -10, 8, -1.87499864, 4.20757543, -1.83257679, 1.26583039, -1.47644883, 0.71061660},
                     {half, half, half});
}

affine_transform<decimal50> printed_even6()
{
    return transform({2, 4, 6}, {4, -4, 0, 9, -24, 16, -0.57759806, 4.61936648, -3.07953907}, {0, 0, 0.018888946});
}

affine_transform<decimal50> join(const affine_transform<decimal50>& odd, const affine_transform<decimal50>& even)
{
    const int size = odd.size(), m = 2 * size;
    affine_transform<decimal50> whole{{}, small_matrix<decimal50>::Zero(m, m), small_vector<decimal50>(m)};
    for (int e = 1; e <= m; ++e) whole.exponents.push_back(e);
    for (const int parity : {0, 1})
        for (int i = 0; i < size; ++i) {
            const auto& part = parity ? even : odd;
            const int row = m == 4 ? 2 * i + parity : i + size * parity;
            for (int j = 0; j < size; ++j) whole.matrix(row, 2 * j + parity) = part.matrix(i, j);
            whole.offset[row] = part.offset[i];
        }
    return whole;
}

affine_transform<decimal50> rounded(const affine_transform<decimal50>& t)
{
    return {t.exponents, t.matrix.cast<double>().cast<decimal50>(), t.offset.cast<double>().cast<decimal50>()};
}

double inverse_residual(const affine_transform<decimal50>& t)
{
    const small_matrix<decimal50> inverse = t.matrix.inverse().eval().cast<double>().cast<decimal50>();
    const small_matrix<decimal50> residual =
        inverse * rounded(t).matrix - small_matrix<decimal50>::Identity(t.size(), t.size());
    return static_cast<double>(residual.lpNorm<Eigen::Infinity>());
}

std::vector<bias_vector_set> bias_vectors()
{
    const auto printed6 = moments({0.5566, 0.489, 0.47869382});
    return {bias_vectors("b1..b4", small_matrix<wide_real>::Identity(4, 4), moments({0.375, 0.375})),
            bias_vectors("Theta4*", join(odd4(), even4()).matrix.cast<wide_real>(), moments({0.628, 0.628})),
            bias_vectors("b1..b6", small_matrix<wide_real>::Identity(6, 6), printed6),
            bias_vectors("Theta6*", join(odd6(), even6()).matrix.cast<wide_real>(), printed6)};
}

std::vector<storage_format> formats(const std::vector<bias_vector_set>& vectors)
{
    // Half a unit in the last place of [1/2, 1), the coarsest in [-1, 1]; half a step of the fixed-point code.
    const double float32 = std::ldexp(1.0, -25), float16 = std::ldexp(1.0, -12);
    const double unorm16 = 0.5 / 65535, unorm10 = 0.5 / 1023;
    const auto &raw4 = vectors[0], &theta4 = vectors[1], &raw6 = vectors[2], &theta6 = vectors[3];
    const auto format = [](const char* name, double rounding, const bias_vector_set& bias, double paper_weight) {
        return storage_format{name, rounding, bias.printed.maximum_norm, bias.farthest.maximum_norm, paper_weight};
    };
    return {format("4 x float", float32, raw4, 3e-7),
            format("4 x half of b1..b4", float16, raw4, 0),
            format("4 x half of Theta4*", float16, theta4, 0),
            format("4 x half", float16 / 2, theta4, 0), // of Theta4* - 1/2
            format("4 x UNORM16", unorm16, theta4, 6e-5),
            format("4 x UNORM16, three roundings", 3 * unorm16, theta4, 6e-5),
            format("6 x float", float32, raw6, 5e-6),
            format("6 x UNORM16", unorm16, theta6, 8e-5),
            format("6 x UNORM10", unorm10, theta6, 4e-3),
            format("6 x UNORM10, two roundings", 2 * unorm10, theta6, 4e-3)};
}

} // namespace gnomon::derivation
