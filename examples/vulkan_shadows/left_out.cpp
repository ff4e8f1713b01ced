// In place of the driver where its build lacks something.
#include "drivers.hpp"

void gnomon::demo::vulkan_shadows(const settings&)
{
    progress("vulkan_shadows", "skipped: built without Vulkan headers, Python or glslangValidator");
}
