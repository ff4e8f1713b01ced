// Prints the coefficients of numerics/exp.h and numerics/trigonometry.h: minimax polynomials by the Remez
// exchange in 100 digits. Each polynomial p in x minimises max |w(x) (f(x) - p(x))|, where the weight w makes
// that the relative error.
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cstdio>
#include <functional>
#include <vector>

using number = boost::multiprecision::cpp_bin_float_100;
using function = std::function<number(number)>;

namespace {

// The solution of a linear system by Gaussian elimination with row pivoting. The last column is the right side.
std::vector<number> solve(std::vector<std::vector<number>> rows)
{
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            if (abs(rows[j][i]) > abs(rows[i][i])) std::swap(rows[i], rows[j]);
        }
        for (std::size_t j = 0; j < n; ++j) {
            if (j == i) continue;
            const number ratio = rows[j][i] / rows[i][i];
            for (std::size_t k = i; k <= n; ++k) rows[j][k] -= ratio * rows[i][k];
        }
    }
    std::vector<number> solution;
    for (std::size_t i = 0; i < n; ++i) solution.push_back(rows[i][n] / rows[i][i]);
    return solution;
}

void print_minimax(const char* name, std::size_t coefficients, number low, number high, const function& f,
                   const function& w)
{
    const std::size_t nodes = coefficients + 1;
    const auto chebyshev = [&](number k, number n) {
        return (low + high) / 2 - (high - low) / 2 * cos(k / n * boost::math::constants::pi<number>());
    };
    std::vector<number> x, p;
    for (std::size_t i = 0; i < nodes; ++i) x.push_back(chebyshev(number(2 * i + 1), number(2 * nodes)));
    number largest = 0;
    for (int iteration = 0; iteration < 8; ++iteration) {
        std::vector<std::vector<number>> rows;
        for (std::size_t i = 0; i < nodes; ++i) {
            std::vector<number> row{w(x[i])};
            while (row.size() < coefficients) row.push_back(row.back() * x[i]);
            row.push_back(i % 2 ? -1 : 1);
            row.push_back(w(x[i]) * f(x[i]));
            rows.push_back(row);
        }
        p = solve(rows);
        p.pop_back();
        // The new nodes are the extrema of the error, one between two of its changes of sign.
        std::vector<number> extrema, errors;
        const int grid = 400;
        for (int i = 0; i < grid; ++i) {
            const number t = chebyshev(number(2 * i + 1), number(2 * grid));
            number value = 0;
            for (std::size_t k = coefficients; k-- > 0;) value = value * t + p[k];
            const number error = w(t) * (f(t) - value);
            if (errors.empty() || error * errors.back() < 0) {
                extrema.push_back(t);
                errors.push_back(error);
            } else if (abs(error) > abs(errors.back())) {
                extrema.back() = t;
                errors.back() = error;
            }
        }
        largest = 0;
        for (const number& error : errors) largest = std::max(largest, number(abs(error)));
        if (extrema.size() == nodes) x = extrema;
    }
    std::printf("%s: relative error 2^%.1f\n", name, static_cast<double>(log2(largest)));
    for (const number& c : p) std::printf("    %.17g\n", static_cast<double>(c));
}

} // namespace

int main()
{
    const number pi = boost::math::constants::pi<number>();
    const number tiny("1e-30");
    // The interval is not symmetric, so that no node is 0, where the weight vanishes.
    for (const std::size_t n : {5u, 10u}) {
        print_minimax(
            "exp x = 1 + x + x^2 p(x)", n, number("-0.347"), number("0.348"),
            [](number x) { return number((exp(x) - 1 - x) / (x * x)); },
            [](number x) { return number(x * x * exp(-x)); });
    }
    // For odd and even functions p is a polynomial in x = y^2, from slightly above 0.
    for (const std::size_t n : {3u, 7u}) {
        const number y = (sqrt(number(2)) - 1) / (sqrt(number(2)) + 1);
        print_minimax(
            "2 artanh y = 2 y + y^3 p(y^2)", n, tiny, number(y * y),
            [](number x) { return number((2 * atanh(sqrt(x)) - 2 * sqrt(x)) / (x * sqrt(x))); },
            [](number x) { return number(x * sqrt(x) / (2 * atanh(sqrt(x)))); });
    }
    for (const std::size_t n : {3u, 6u}) {
        print_minimax(
            "sin y = y + y^3 p(y^2)", n, tiny, number(pi * pi / 16),
            [](number x) { return number((sin(sqrt(x)) - sqrt(x)) / (x * sqrt(x))); },
            [](number x) { return number(x * sqrt(x) / sin(sqrt(x))); });
        print_minimax(
            "cos y = 1 - y^2 / 2 + y^4 p(y^2)", n, tiny, number(pi * pi / 16),
            [](number x) { return number((cos(sqrt(x)) - 1 + x / 2) / (x * x)); },
            [](number x) { return number(x * x / cos(sqrt(x))); });
    }
    for (const std::size_t n : {5u, 11u}) {
        const number y = tan(number(pi / 8));
        print_minimax(
            "arctan y = y + y^3 p(y^2)", n, tiny, number(y * y),
            [](number x) { return number((atan(sqrt(x)) - sqrt(x)) / (x * sqrt(x))); },
            [](number x) { return number(x * sqrt(x) / atan(sqrt(x))); });
    }
}
