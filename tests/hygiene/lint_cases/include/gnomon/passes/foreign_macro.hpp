// expect: foreign macro
#ifndef GNOMON_PASSES_FOREIGN_MACRO_HPP
#define GNOMON_PASSES_FOREIGN_MACRO_HPP
#define ASSERT(x)
#endif
