// expect: macro of others
#ifndef GNOMON_PASSES_MACRO_OF_OTHERS_HPP
#define GNOMON_PASSES_MACRO_OF_OTHERS_HPP

#include <algorithm>

namespace gnomon {

inline int lesser(int a, int b) { return std::min(a, b); }

} // namespace gnomon
#endif
