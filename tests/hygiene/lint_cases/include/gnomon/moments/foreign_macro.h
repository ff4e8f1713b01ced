// expect: foreign macro
#ifndef GNOMON_MOMENTS_FOREIGN_MACRO_H
#define GNOMON_MOMENTS_FOREIGN_MACRO_H
#define SQUARE(x) ((x) * (x))
#endif
