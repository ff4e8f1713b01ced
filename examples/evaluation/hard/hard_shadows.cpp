#include "comparison.hpp"

namespace gnomon::evaluation {

namespace {

// The scene of Peters et al. 2017, Figure 4, by every method.
void hard_shadows(const settings& how)
{
    compare_methods(
        {.driver = "hard_shadows",
         .scene = "fence",
         .summary = "The same hard shadows by every filter of the library: what each costs, and where each lets "
                    "light through.",
         .of_insets = "leak",
         .first = {"evsm_half", "msm4_unorm16"},
         .is_front = true},
        how);
}

const registered<driver> entry{driver{.id = "hard_shadows", .label = "Hard shadows", .order = 10, .run = hard_shadows}};

} // namespace

} // namespace gnomon::evaluation
