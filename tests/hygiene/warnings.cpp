// Compiled with every warning of a compiler, never run: all headers as a user's own, and then, as a system header whose
// own warnings count for nothing, a test that instantiates all kernels and passes.
#include "all_headers.hpp"

#include <allocation.cpp>
