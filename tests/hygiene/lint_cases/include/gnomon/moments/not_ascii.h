// expect: not ASCII
#ifndef GNOMON_MOMENTS_NOT_ASCII_H
#define GNOMON_MOMENTS_NOT_ASCII_H
// Palmér
#endif
