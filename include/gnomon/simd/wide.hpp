// Two packs as one Real. Every operation is issued twice, so that the work of one half fills the latency of the other.
// A kernel is one long chain of dependent operations, longer than a processor looks ahead; with twice the lanes it
// takes less time for each lane.
//
//     using real = gnomon::wide<gnomon::pack<xsimd::batch<float>>>;
//
// The lanes of low come first. Results have the bits of the pack; loads and stores are those of xsimd.
#ifndef GNOMON_SIMD_WIDE_HPP
#define GNOMON_SIMD_WIDE_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <cstddef>

namespace gnomon {

template <class Mask> struct wide_mask {
    Mask low, high;

    friend GNOMON_INLINE wide_mask operator&&(wide_mask a, wide_mask b) { return {a.low && b.low, a.high && b.high}; }
    friend GNOMON_INLINE wide_mask operator||(wide_mask a, wide_mask b) { return {a.low || b.low, a.high || b.high}; }
    friend GNOMON_INLINE wide_mask operator!(wide_mask a) { return {!a.low, !a.high}; }
    friend GNOMON_INLINE bool any GNOMON_NO_MACRO(wide_mask a) { return gnomon_any(a.low || a.high); }
};

template <class Pack> struct wide {
    using value_type = lane_t<Pack>;
    using mask = wide_mask<mask_t<Pack>>;

    Pack low, high;

    static constexpr std::size_t size = 2 * Pack::size;

    static GNOMON_INLINE wide load_aligned(const value_type* from)
    {
        return {Pack::load_aligned(from), Pack::load_aligned(from + Pack::size)};
    }
    static GNOMON_INLINE wide load_unaligned(const value_type* from)
    {
        return {Pack::load_unaligned(from), Pack::load_unaligned(from + Pack::size)};
    }
    GNOMON_INLINE void store_aligned(value_type* to) const
    {
        low.store_aligned(to);
        high.store_aligned(to + Pack::size);
    }
    GNOMON_INLINE void store_unaligned(value_type* to) const
    {
        low.store_unaligned(to);
        high.store_unaligned(to + Pack::size);
    }

    wide() = default;
    GNOMON_INLINE explicit wide(value_type every_lane) : low(every_lane), high(every_lane) {}
    GNOMON_INLINE wide(Pack first, Pack second) : low(first), high(second) {}

    friend GNOMON_INLINE wide operator-(wide a) { return {-a.low, -a.high}; }
    friend GNOMON_INLINE wide operator+(wide a, wide b) { return {a.low + b.low, a.high + b.high}; }
    friend GNOMON_INLINE wide operator-(wide a, wide b) { return {a.low - b.low, a.high - b.high}; }
    friend GNOMON_INLINE wide operator*(wide a, wide b) { return {a.low * b.low, a.high * b.high}; }
    friend GNOMON_INLINE wide operator/(wide a, wide b) { return {a.low / b.low, a.high / b.high}; }
    friend GNOMON_INLINE mask operator<(wide a, wide b) { return {a.low < b.low, a.high < b.high}; }
    friend GNOMON_INLINE mask operator>(wide a, wide b) { return {a.low > b.low, a.high > b.high}; }
    friend GNOMON_INLINE mask operator<=(wide a, wide b) { return {a.low <= b.low, a.high <= b.high}; }
    friend GNOMON_INLINE mask operator>=(wide a, wide b) { return {a.low >= b.low, a.high >= b.high}; }
    friend GNOMON_INLINE mask operator==(wide a, wide b) { return {a.low == b.low, a.high == b.high}; }
    friend GNOMON_INLINE mask operator!=(wide a, wide b) { return !(a == b); }

    friend GNOMON_INLINE wide select GNOMON_NO_MACRO(mask m, wide a, wide b)
    {
        return {gnomon_select(m.low, a.low, b.low), gnomon_select(m.high, a.high, b.high)};
    }
    friend GNOMON_INLINE wide abs GNOMON_NO_MACRO(wide a) { return {gnomon_abs(a.low), gnomon_abs(a.high)}; }
    friend GNOMON_INLINE wide sqrt(wide a) { return {gnomon_sqrt(a.low), gnomon_sqrt(a.high)}; }
};

template <class Pack> struct pack_operations<wide<Pack>> {
    static constexpr bool native = is_native<Pack>, fused = is_fused<Pack>;

    static GNOMON_INLINE wide<Pack> min GNOMON_NO_MACRO(wide<Pack> a, wide<Pack> b)
    {
        return {gnomon_min(a.low, b.low), gnomon_min(a.high, b.high)};
    }
    static GNOMON_INLINE wide<Pack> max GNOMON_NO_MACRO(wide<Pack> a, wide<Pack> b)
    {
        return {gnomon_max(a.low, b.low), gnomon_max(a.high, b.high)};
    }
    static GNOMON_INLINE wide<Pack> fma(wide<Pack> a, wide<Pack> b, wide<Pack> c)
    {
        return {gnomon_fma(a.low, b.low, c.low), gnomon_fma(a.high, b.high, c.high)};
    }
    static GNOMON_INLINE wide<Pack> high_part(wide<Pack> a)
    {
        return {gnomon_high_part(a.low), gnomon_high_part(a.high)};
    }
    static GNOMON_INLINE wide<Pack> power_of_two(wide<Pack> n)
    {
        return {gnomon_power_of_two(n.low), gnomon_power_of_two(n.high)};
    }
};

} // namespace gnomon
#endif
