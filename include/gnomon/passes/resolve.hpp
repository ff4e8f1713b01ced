// Lists of any length, resolved: what of some ranges is in front at any time, as spans of time that do not overlap,
// the lower envelope over the shutter interval (Gribel et al. 2010; Palmer 2011, 2.1). A receiver asks the spans and
// gets the same answer as of all ranges, and static_receiver.h may add them up.
//
// Ranges come one at a time. A span keeps the number of its range, not cut depths, and two ranges always cross at one
// time, computed from the ranges as they came. So depths are interpolated once, at the end, and the order in which
// ranges come matters only where three lines meet within rounding.
#ifndef GNOMON_PASSES_RESOLVE_HPP
#define GNOMON_PASSES_RESOLVE_HPP

#include "../motion/range.h"
#include "expects.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon {

/// From t0 to t1 the range of this number is in front.
template <class T> struct visible_span {
    T t0, t1;
    std::uint32_t range;
};

/// Room that resolving n ranges takes. Their spans are the lower envelope of n segments, a Davenport-Schinzel sequence
/// of order 3, which is no longer than n (1 + 2 H(n - 1)), H the harmonic numbers (Sharir & Agarwal 1995, 1.2); an
/// insertion rewrites as many as it changes, aside.
constexpr std::size_t resolve_capacity(std::size_t n) { return 2 * (n * (3 + 2 * std::size_t(std::bit_width(n))) + 2); }

/// The spans of one texel's ranges, in the caller's memory.
template <class T> class range_resolver {
  public:
    /// spans: at least resolve_capacity(ranges.size()).
    range_resolver(std::span<const depth_time_range<T>> ranges, std::span<visible_span<T>> spans)
        : ranges_(ranges), spans_(spans.first(spans.size() / 2)), changed_(spans.last(spans.size() - spans.size() / 2))
    {
        GNOMON_EXPECTS(spans.size() >= resolve_capacity(ranges.size()),
                       mismatch("resolve", "spans.size()", spans.size(), "resolve_capacity(ranges.size())",
                                resolve_capacity(ranges.size())));
    }

    /// In order; in time that nothing covers there is none.
    std::span<const visible_span<T>> spans() const { return spans_.first(count_); }

    /// A range of the list, by its number. One without a duration, or with a depth that is not finite, changes nothing.
    void insert(std::uint32_t number)
    {
        const depth_time_range<T>& r = ranges_[number];
        if (!(r.t0 < r.t1) || !std::isfinite(r.z0) || !std::isfinite(r.z1)) return;
        std::size_t first = 0;
        while (first < count_ && spans_[first].t1 <= r.t0) ++first;
        if (is_behind(r, first)) return;
        changes_ = 0;
        T reached = r.t0;
        std::size_t next = first;
        for (; next < count_ && spans_[next].t0 < r.t1; ++next) {
            const visible_span<T> old = spans_[next];
            const T begin = std::max(old.t0, r.t0), end = std::min(old.t1, r.t1);
            const succession who = succession_of(number, old.range);
            const T change = std::clamp(who.change, begin, end);
            change_to({old.t0, begin, old.range});
            change_to({reached, begin, number});
            change_to({begin, change, who.early});
            change_to({change, end, who.late});
            change_to({end, old.t1, old.range});
            reached = end;
        }
        change_to({reached, r.t1, number});
        const std::size_t removed = next - first, rest = count_ - next;
        GNOMON_EXPECTS(first + changes_ + rest <= spans_.size(),
                       mismatch("resolve", "spans", first + changes_ + rest, "capacity", spans_.size()));
        if (changes_ != removed)
            std::copy_n(spans_.begin() + std::ptrdiff_t(next), rest, spans_.begin() + std::ptrdiff_t(first + changes_));
        std::copy_n(changed_.begin(), changes_, spans_.begin() + std::ptrdiff_t(first));
        count_ = first + changes_ + rest;
    }

  private:
    /// Which of two ranges is in front before a change, and which after it.
    struct succession {
        std::uint32_t early, late;
        T change;
    };

    /// Whether all spans in its time, from the first on, are in front of all of it.
    bool is_behind(const depth_time_range<T>& r, std::size_t first) const
    {
        T reached = r.t0;
        for (; first < count_ && reached < r.t1 && spans_[first].t0 <= reached; ++first) {
            const depth_time_range<T>& front = ranges_[spans_[first].range];
            if (!(std::max(front.z0, front.z1) < std::min(r.z0, r.z1))) return false;
            reached = spans_[first].t1;
        }
        return !(reached < r.t1);
    }

    /// Depths as near as that count as one, lest rounding makes spans of no use where surfaces meet.
    static constexpr T tie = T(0x1p-18);

    /// The same whichever comes first. At one depth throughout, the lower id is in front.
    succession succession_of(std::uint32_t i, std::uint32_t j) const
    {
        if (j < i) std::swap(i, j);
        const depth_time_range<T>& a = ranges_[i];
        const depth_time_range<T>& b = ranges_[j];
        if (std::max(a.z0, a.z1) < std::min(b.z0, b.z1)) return {i, i, T(0)};
        if (std::max(b.z0, b.z1) < std::min(a.z0, a.z1)) return {j, j, T(0)};
        const T begin = std::max(a.t0, b.t0), end = std::min(a.t1, b.t1);
        const auto distance = [&](T t) {
            const T d = range_depth(a, t) - range_depth(b, t);
            return std::abs(d) <= tie ? T(0) : d;
        };
        const T early = distance(begin), late = distance(end);
        if (early == 0 && late == 0) return b.id < a.id ? succession{j, j, T(0)} : succession{i, i, T(0)};
        if (early <= 0 && late <= 0) return {i, i, T(0)};
        if (early >= 0 && late >= 0) return {j, j, T(0)};
        const T change = range_crossing(a, b);
        return early < 0 ? succession{i, j, change} : succession{j, i, change};
    }

    void change_to(const visible_span<T>& s)
    {
        if (!(s.t0 < s.t1)) return;
        if (changes_ > 0 && changed_[changes_ - 1].range == s.range && changed_[changes_ - 1].t1 == s.t0) {
            changed_[changes_ - 1].t1 = s.t1;
            return;
        }
        GNOMON_EXPECTS(changes_ < changed_.size(),
                       mismatch("resolve", "changed spans", changes_ + 1, "capacity", changed_.size()));
        changed_[changes_++] = s;
    }

    std::span<const depth_time_range<T>> ranges_;
    std::span<visible_span<T>> spans_, changed_;
    std::size_t count_ = 0, changes_ = 0;
};

/// The spans of a list, in spans, which has room for resolve_capacity(ranges.size()).
template <class T>
std::span<const visible_span<T>> resolve_ranges(std::span<const depth_time_range<T>> ranges,
                                                std::span<visible_span<T>> spans)
{
    range_resolver<T> resolver(ranges, spans);
    for (std::uint32_t i = 0; i < ranges.size(); ++i) resolver.insert(i);
    return resolver.spans();
}

/// The part of its range that a span shows.
template <class T> depth_time_range<T> range_of(std::span<const depth_time_range<T>> ranges, const visible_span<T>& s)
{
    return range_clip(ranges[s.range], s.t0, s.t1);
}

} // namespace gnomon
#endif
