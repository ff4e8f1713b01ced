#include "comparison.hpp"

void gnomon::evaluation::hard_shadows(const settings& how)
{
    const double aspect = double(how.width) / how.height;
    compare_methods("hard_shadows", renderer::fence_stage(aspect), how);
    compare_methods("contact", renderer::contact_stage(aspect), how);
}
