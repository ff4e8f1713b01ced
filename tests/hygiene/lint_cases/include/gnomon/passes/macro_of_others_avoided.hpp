// expect: nothing
#ifndef GNOMON_PASSES_MACRO_OF_OTHERS_AVOIDED_HPP
#define GNOMON_PASSES_MACRO_OF_OTHERS_AVOIDED_HPP

#include <algorithm>

namespace gnomon {

inline int lesser(int min, int max) { return (std::min)(min, max); }

} // namespace gnomon
#endif
