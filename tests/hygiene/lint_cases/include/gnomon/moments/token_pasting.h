// expect: token pasting
#ifndef GNOMON_MOMENTS_TOKEN_PASTING_H
#define GNOMON_MOMENTS_TOKEN_PASTING_H
#define GNOMON_JOIN(a, b) a##b
#endif
