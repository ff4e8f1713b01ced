#include "comparison.hpp"

namespace gnomon::evaluation {

namespace {

// The scene of Peters et al. 2017, Figure 4, and a scene of contacts, left in FOLDER/contact, by every method.
void hard_shadows(const settings& how)
{
    const double aspect = double(how.width) / how.height;
    compare_methods("hard_shadows", renderer::fence_stage(aspect), how);
    compare_methods("contact", renderer::contact_stage(aspect), how);
}

const registered<driver> entry{driver{.id = "hard_shadows", .label = "Hard shadows", .order = 10, .run = hard_shadows}};

} // namespace

} // namespace gnomon::evaluation
