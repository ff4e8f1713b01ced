// Metal: C++14 with address spaces. Kernels stay templates; Real is float.
// For the same bits as on the CPU compile with -fno-fast-math and -ffp-contract=off.
#ifndef GNOMON_PORTABLE_MSL_H
#define GNOMON_PORTABLE_MSL_H

#include <metal_stdlib>

#define GNOMON_NAMESPACE_BEGIN namespace gnomon {
#define GNOMON_NAMESPACE_END }
#define GNOMON_KERNEL template <class Real> inline
#define GNOMON_STRUCT template <class Real> struct
#define GNOMON_T(name) name<Real>
#define GNOMON_LIST_KERNEL template <class Real, int capacity = GNOMON_RANGE_CAPACITY> inline
#define GNOMON_LIST_STRUCT template <class Real, int capacity = GNOMON_RANGE_CAPACITY> struct
#define GNOMON_LIST_T(name) name<Real, capacity>
#define GNOMON_CAPACITY capacity
#define GNOMON_MASK bool
#define GNOMON_SETTING gnomon::same_t<Real>
#define GNOMON_CONSTANT(name, value) constant constexpr float name = float(value)
#define GNOMON_LITERAL(name) Real(name)
#define GNOMON_FUSED true
#define GNOMON_DIGITS 24
#define GNOMON_SPLITTER Real(gnomon_splitter)
#define GNOMON_PIVOT_FLOOR Real(gnomon_pivot_floor)

namespace gnomon {

constant constexpr float gnomon_splitter = 4097.0f;
constant constexpr float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

template <class T> struct same {
    using type = T;
};
template <class T> using same_t = typename same<T>::type;

template <class T> inline T gnomon_select(bool mask, T a, T b) { return mask ? a : b; }
inline bool gnomon_any(bool mask) { return mask; }
template <class T> inline T gnomon_min(T a, T b) { return a < b ? a : b; }
template <class T> inline T gnomon_max(T a, T b) { return b < a ? a : b; }
template <class T> inline T gnomon_abs(T a) { return metal::fabs(a); }
template <class T> inline T gnomon_sqrt(T a) { return metal::precise::sqrt(a); }
template <class T> inline T gnomon_fma(T a, T b, T c) { return metal::fma(a, b, c); }
template <class T> inline T gnomon_product(T a, T b) { return metal::fma(a, b, T(-0.0f)); }
template <class T> inline T gnomon_difference(T a, T b) { return a - b; }
template <class T> inline T gnomon_power_of_two(T n) { return as_type<T>((int(n) + 127) << 23); }

} // namespace gnomon
#endif
