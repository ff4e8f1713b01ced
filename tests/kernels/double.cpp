#include "every_kernel.hpp"

TEST_CASE("every kernel in double: results in [0, 1] where promised, packs as scalars")
{
    gnomon::test::check_every_kernel<double>();
}
