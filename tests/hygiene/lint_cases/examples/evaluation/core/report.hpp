// expect: nothing
#include "renderer/vulkan/device.hpp"
#include "renderer/trace/tracer.hpp"
