#include "comparison.hpp"

void gnomon::demo::hard_shadows(const settings& how)
{
    compare_methods("hard_shadows", toolbox::fence_stage(double(how.width) / how.height), how);
}
