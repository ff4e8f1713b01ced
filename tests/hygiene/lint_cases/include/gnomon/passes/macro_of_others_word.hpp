// expect: macro of others
#ifndef GNOMON_PASSES_MACRO_OF_OTHERS_WORD_HPP
#define GNOMON_PASSES_MACRO_OF_OTHERS_WORD_HPP

inline int twice(int small) { return 2; }

#endif
