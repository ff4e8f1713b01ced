// In place of the driver where its build lacks something.
#include "evaluation/core/drivers.hpp"

void gnomon::evaluation::vulkan_shadows(const settings&)
{
    progress("vulkan_shadows", "skipped: built without Vulkan headers, Python or glslangValidator");
}
