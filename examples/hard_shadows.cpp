#include "comparison.hpp"

void gnomon::demo::hard_shadows(const settings& how)
{
    const double aspect = double(how.width) / how.height;
    compare_methods("hard_shadows", toolbox::fence_stage(aspect), how);
    compare_methods("contact", toolbox::contact_stage(aspect), how);
}
