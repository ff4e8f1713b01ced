// expect: mutable global
#ifndef GNOMON_PASSES_MUTABLE_GLOBAL_HPP
#define GNOMON_PASSES_MUTABLE_GLOBAL_HPP

namespace gnomon {

inline int calls()
{
    static int count = 0;
    return ++count;
}

} // namespace gnomon
#endif
