// The largest error that a search finds, against the one that a header states.
#pragma once

#include "support/climber.hpp"
#include "support/rounding.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace gnomon::test {

using place = std::vector<double>;
using wide = long double;

/// The error of value, relative to exact, in units of 2^-p.
template <class T> double relative(T value, wide exact)
{
    return exact == 0 ? double(std::abs(value)) / u<T> : double(std::abs(wide(value) - exact) / std::abs(exact)) / u<T>;
}

/// A number between 2^-exponent and 2^exponent.
template <class T> T magnitude(double p, double exponent) { return T(std::exp2(exponent * (2 * p - 1))); }

/// The climbed error keeps to the limit, and is not so far from it that the measure would see none.
template <class Score> void check_error(double limit, std::size_t dimensions, std::int64_t evaluations, Score score)
{
    const summit found = climb(dimensions, evaluations, 1, score);
    CHECK_MESSAGE(found.score <= limit, found.score);
    CHECK_MESSAGE(found.score > limit / 8, found.score);
}

} // namespace gnomon::test
