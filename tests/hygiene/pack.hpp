// The packs that every kernel is tried with: 4, 8 and 16 lanes of float, 2, 4 and 8 of double, as far as the target has
// them.
#ifndef GNOMON_TESTS_HYGIENE_PACK_HPP
#define GNOMON_TESTS_HYGIENE_PACK_HPP

#include <gnomon/simd/xsimd.hpp>

#include <xsimd/xsimd.hpp>

template <class T, std::size_t lanes> using pack = xsimd::make_sized_batch_t<T, lanes>;

#if defined(__AVX512F__)
#define FOR_EACH_PACK(X) X(4, float) X(8, float) X(16, float) X(2, double) X(4, double) X(8, double)
#elif defined(__AVX2__)
#define FOR_EACH_PACK(X) X(4, float) X(8, float) X(2, double) X(4, double)
#else
#define FOR_EACH_PACK(X) X(4, float) X(2, double)
#endif

#endif
