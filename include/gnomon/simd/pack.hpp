// The Real that has the lanes of a pack of another library: the pack itself where its own operators do all that a kernel
// needs, and with the bits of the scalar; else a wrapper with the operators that the adapter of the library has.
//
//     using real = gnomon::pack<xsimd::batch<float>>;                           // with simd/xsimd.hpp
//     using real = gnomon::pack<std::experimental::native_simd<float>>;         // with simd/std_simd.hpp
#ifndef GNOMON_SIMD_PACK_HPP
#define GNOMON_SIMD_PACK_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <cstddef>

namespace gnomon {

/// A pack with operators of pack_operations<Pack> in place of those that it lacks or that round otherwise.
template <class Pack> struct wrapped_pack {
    using value_type = lane_t<Pack>;
    using mask = mask_t<Pack>;
    using own = pack_operations<Pack>;

    static constexpr std::size_t size = own::size;

    Pack value;

    static GNOMON_INLINE wrapped_pack load_aligned(const value_type* from) { return own::load(from); }
    static GNOMON_INLINE wrapped_pack load_unaligned(const value_type* from) { return own::load(from); }
    GNOMON_INLINE void store_aligned(value_type* to) const { own::store(value, to); }
    GNOMON_INLINE void store_unaligned(value_type* to) const { own::store(value, to); }

    wrapped_pack() = default;
    GNOMON_INLINE wrapped_pack(value_type every_lane) : value(every_lane) {}
    GNOMON_INLINE wrapped_pack(Pack p) : value(p) {}
    GNOMON_INLINE operator Pack() const { return value; }

    friend GNOMON_INLINE wrapped_pack operator-(wrapped_pack a) { return -a.value; }
    friend GNOMON_INLINE wrapped_pack operator+(wrapped_pack a, wrapped_pack b) { return a.value + b.value; }
    friend GNOMON_INLINE wrapped_pack operator-(wrapped_pack a, wrapped_pack b) { return a.value - b.value; }
    friend GNOMON_INLINE wrapped_pack operator*(wrapped_pack a, wrapped_pack b) { return a.value * b.value; }
    friend GNOMON_INLINE wrapped_pack operator/(wrapped_pack a, wrapped_pack b)
    {
        return own::divide(a.value, b.value);
    }
    friend GNOMON_INLINE mask operator<(wrapped_pack a, wrapped_pack b) { return a.value < b.value; }
    friend GNOMON_INLINE mask operator>(wrapped_pack a, wrapped_pack b) { return a.value > b.value; }
    friend GNOMON_INLINE mask operator<=(wrapped_pack a, wrapped_pack b) { return a.value <= b.value; }
    friend GNOMON_INLINE mask operator>=(wrapped_pack a, wrapped_pack b) { return a.value >= b.value; }
    friend GNOMON_INLINE mask operator==(wrapped_pack a, wrapped_pack b) { return a.value == b.value; }
    friend GNOMON_INLINE mask operator!=(wrapped_pack a, wrapped_pack b) { return !(a == b); }
    friend GNOMON_INLINE wrapped_pack select GNOMON_NO_MACRO(mask m, wrapped_pack a, wrapped_pack b)
    {
        return own::select GNOMON_NO_MACRO(m, a.value, b.value);
    }
    friend GNOMON_INLINE wrapped_pack abs GNOMON_NO_MACRO(wrapped_pack a) { return gnomon_abs(a.value); }
    friend GNOMON_INLINE wrapped_pack sqrt(wrapped_pack a) { return own::sqrt(a.value); }
};

template <class Pack> struct pack_operations<wrapped_pack<Pack>> : pack_operations<Pack> {
    static constexpr bool native = true;
};

template <class Pack> using pack = std::conditional_t<is_native<Pack>, Pack, wrapped_pack<Pack>>;

} // namespace gnomon
#endif
