// In place of the driver where its build lacks something.
#include "evaluation/core/driver.hpp"

namespace gnomon::evaluation {

namespace {

void left_out(const settings&)
{
    progress("vulkan_shadows", "skipped: built without Vulkan headers or glslangValidator");
}

const registered<driver> entry{
    driver{.id = "vulkan_shadows", .label = "The same shadows on Vulkan", .order = 20, .run = left_out}};

} // namespace

} // namespace gnomon::evaluation
