// expect: include of a .hpp
#ifndef GNOMON_MOMENTS_HPP_FROM_H_H
#define GNOMON_MOMENTS_HPP_FROM_H_H
#include "../numerics/half.hpp"
#endif
