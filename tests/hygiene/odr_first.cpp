#include "all_headers.hpp"

#include <doctest/doctest.h>

double saturated_elsewhere(double x);

TEST_CASE("two units share one definition of everything")
{
    CHECK(gnomon::saturate_or_zero(2.0) == saturated_elsewhere(2.0));
}
