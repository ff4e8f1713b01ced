// expect: nothing
#include "renderer/trace/tracer.hpp"
