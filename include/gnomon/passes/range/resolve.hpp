// Resolved lists of any length: the parts of ranges that are in front at each time, as disjoint spans of time, the
// lower envelope over the shutter interval (Gribel et al. 2010; Palmer 2011, 2.1). For a receiver whose depth differs
// from those of the ranges by more than resolve_tie, the spans give the same answer as all ranges. static_receiver.h
// adds them up.
//
// A receiver ignores the ranges of its own id, so it may see past a span that is in front. If that can happen
// (range_ids), the spans of a second layer follow each span: the ranges of other ids that are in front while that span
// lasts. range_is_second_layer tells these spans from the others; they count only for receivers of the span's id.
//
// Ranges are inserted one at a time. A span stores the number of its range, not clipped depths, and two ranges always
// cross at a single time, computed from the ranges as they were given. So depths are interpolated only once, at the
// end, and the order of insertion matters only where three lines meet within rounding.
#ifndef GNOMON_PASSES_RANGE_RESOLVE_HPP
#define GNOMON_PASSES_RANGE_RESOLVE_HPP

#include "map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

GNOMON_NAMESPACE_BEGIN

/// A span of time, from t0 to t1, and the number of the range that is in front.
template <class T> struct visible_span {
    T t0, t1;
    std::uint32_t range;
};

/// The largest distance of depths that count as equal, which avoids useless spans where surfaces meet within rounding.
/// Error: where n ranges come that close to one another, the one in front may be n - 1 ties behind the nearest.
template <class T> inline constexpr T resolve_tie = T(0x1p-18);

namespace detail {

/// Upper bound of the number of spans of n ranges. Their lower envelope is a Davenport-Schinzel sequence of order 3,
/// with at most n (1 + 2 H(n - 1)) elements, H the harmonic numbers (Sharir & Agarwal 1995, 1.2).
constexpr std::size_t envelope_capacity(std::size_t n)
{
    const int bits = std::numeric_limits<std::size_t>::digits - std::countl_zero(n);
    return n * (3 + 2 * std::size_t(bits)) + 2;
}

} // namespace detail

/// Number of spans that resolving n ranges needs, with E = envelope_capacity(n). Ids of surfaces need 2 E: the spans,
/// and as much scratch for those that an insertion changes. Any ids need up to 6 E more, for the spans of both layers.
/// Proof: colour each id at random with one of two colours. Consider a span of the second layer that does not begin
/// together with one in front. It begins in the envelope of its colour if its own id and that of the span before it
/// have one colour and the id in front has the other, which holds for one colouring in four. Both envelopes have E
/// spans together, so there are at most 4 E such spans; E spans are in front, and E begin together with these.
constexpr std::size_t resolve_capacity(std::size_t n, range_ids ids)
{
    return (ids == range_ids::surfaces ? 2 : 9) * detail::envelope_capacity(n);
}

namespace detail {

/// The spans in front among the inserted ranges of a texel, in the caller's memory.
template <class T> class front_resolver {
  public:
    /// Sizes of spans and changed: envelope_capacity(ranges.size()) each.
    front_resolver(std::span<const depth_time_range<T>> ranges, std::span<visible_span<T>> spans,
                   std::span<visible_span<T>> changed)
        : ranges_(ranges), spans_(spans), changed_(changed)
    {}

    /// Remove all ranges, and clip those to come to the times [from, to].
    void restart(T from, T to) { count_ = 0, from_ = from, to_ = to; }

    /// The spans in order; none where no range lasts.
    std::span<const visible_span<T>> spans() const { return spans_.first(count_); }

    /// Insert a range of the list by its number. A range without duration, or with a depth that is not finite, changes
    /// nothing.
    void insert(std::uint32_t number)
    {
        const depth_time_range<T>& r = ranges_[number];
        const T t0 = (std::max)(r.t0, from_), t1 = (std::min)(r.t1, to_);
        if (!(r.t0 < r.t1 && t0 < t1) || !(std::isfinite)(r.z0) || !(std::isfinite)(r.z1)) return;
        std::size_t first = 0;
        while (first < count_ && spans_[first].t1 <= t0) ++first;
        if (is_behind(r, t0, t1, first)) return;
        changes_ = 0;
        bool unchanged = true;
        T reached = t0;
        std::size_t next = first;
        for (; next < count_ && spans_[next].t0 < t1; ++next) {
            const visible_span<T> old = spans_[next];
            const T begin = (std::max)(old.t0, t0), end = (std::min)(old.t1, t1);
            const front_order order = order_of(number, old.range);
            unchanged = unchanged && !(reached < begin) && order.before == old.range && order.after == old.range;
            const T change = (std::clamp)(order.change, begin, end);
            change_to({old.t0, begin, old.range});
            change_to({reached, begin, number});
            change_to({begin, change, order.before});
            change_to({change, end, order.after});
            change_to({end, old.t1, old.range});
            reached = end;
        }
        if (unchanged && !(reached < t1)) return;
        change_to({reached, t1, number});
        const std::size_t removed = next - first, rest = count_ - next;
        GNOMON_EXPECTS(first + changes_ + rest <= spans_.size(),
                       mismatch("resolve", "spans", first + changes_ + rest, "capacity", spans_.size()));
        if (changes_ != removed && rest > 0)
            std::memmove(&spans_[first + changes_], &spans_[next], rest * sizeof spans_[0]);
        std::copy_n(changed_.begin(), changes_, spans_.begin() + std::ptrdiff_t(first));
        count_ = first + changes_ + rest;
    }

  private:
    /// The numbers of the ranges in front before and after a change.
    struct front_order {
        std::uint32_t before, after;
        T change;
    };

    /// True if all spans from t0 to t1, from `first` on, are in front of all of r.
    bool is_behind(const depth_time_range<T>& r, T t0, T t1, std::size_t first) const
    {
        T reached = t0;
        for (; first < count_ && reached < t1 && spans_[first].t0 <= reached; ++first) {
            const depth_time_range<T>& front = ranges_[spans_[first].range];
            if (!((std::max)(front.z0, front.z1) < (std::min)(r.z0, r.z1))) return false;
            reached = spans_[first].t1;
        }
        return !(reached < t1);
    }

    /// The order of two ranges, independent of which comes first. At equal depth throughout, the lower id is in front;
    /// where both ends tie, the range that is nearer on average.
    front_order order_of(std::uint32_t i, std::uint32_t j) const
    {
        if (j < i) (std::swap)(i, j);
        const depth_time_range<T>& a = ranges_[i];
        const depth_time_range<T>& b = ranges_[j];
        if ((std::max)(a.z0, a.z1) < (std::min)(b.z0, b.z1)) return {i, i, T(0)};
        if ((std::max)(b.z0, b.z1) < (std::min)(a.z0, a.z1)) return {j, j, T(0)};
        const T begin = (std::max)(a.t0, b.t0), end = (std::min)(a.t1, b.t1);
        const T slope_a = (a.z1 - a.z0) / (a.t1 - a.t0), slope_b = (b.z1 - b.z0) / (b.t1 - b.t0);
        const auto distance = [&](T t) { return (a.z0 + (t - a.t0) * slope_a) - (b.z0 + (t - b.t0) * slope_b); };
        const T early = distance(begin), late = distance(end);
        const bool early_tie = (std::abs)(early) <= resolve_tie<T>, late_tie = (std::abs)(late) <= resolve_tie<T>;
        if (early_tie && late_tie) {
            const bool b_first = early + late == 0 ? b.id < a.id : early + late > 0;
            return b_first ? front_order{j, j, T(0)} : front_order{i, i, T(0)};
        }
        if ((early < 0 || early_tie) && (late < 0 || late_tie)) return {i, i, T(0)};
        if ((early > 0 || early_tie) && (late > 0 || late_tie)) return {j, j, T(0)};
        const T change = begin + (end - begin) * (early / (early - late));
        return early < 0 ? front_order{i, j, change} : front_order{j, i, change};
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
    T from_ = std::numeric_limits<T>::lowest(), to_ = (std::numeric_limits<T>::max)();
};

} // namespace detail

/// Resolve a list into spans, which has room for resolve_capacity(ranges.size(), ids). The result holds the spans in
/// front, in order, each followed by those of its second layer, if there are any.
template <class T>
std::span<const visible_span<T>> resolve_ranges(std::span<const depth_time_range<T>> ranges,
                                                std::span<visible_span<T>> spans, range_ids ids)
{
    GNOMON_EXPECTS(spans.size() >= resolve_capacity(ranges.size(), ids),
                   mismatch("resolve", "spans.size()", spans.size(), "resolve_capacity(ranges.size(), ids)",
                            resolve_capacity(ranges.size(), ids)));
    const std::size_t room = detail::envelope_capacity(ranges.size());
    detail::front_resolver<T> front(ranges, spans.first(room), spans.subspan(room, room));
    for (std::uint32_t i = 0; i < ranges.size(); ++i) front.insert(i);
    if (ids == range_ids::surfaces) return front.spans();

    detail::front_resolver<T> second(ranges, spans.subspan(room, room), spans.subspan(2 * room, room));
    const std::span<visible_span<T>> both = spans.subspan(3 * room);
    std::size_t count = 0;
    const auto keep = [&](const visible_span<T>& s) {
        GNOMON_EXPECTS(count < both.size(), mismatch("resolve", "spans", count + 1, "capacity", both.size()));
        both[count++] = s;
    };
    for (const visible_span<T>& s : front.spans()) {
        keep(s);
        second.restart(s.t0, s.t1);
        for (std::uint32_t i = 0; i < ranges.size(); ++i)
            if (!(ranges[i].id == ranges[s.range].id)) second.insert(i);
        for (const visible_span<T>& behind : second.spans()) keep(behind);
    }
    return both.first(count);
}

/// The part of its range that a span shows.
template <class T> depth_time_range<T> range_of(std::span<const depth_time_range<T>> ranges, const visible_span<T>& s)
{
    const depth_time_range<T>& r = ranges[s.range];
    return s.t0 <= r.t0 && r.t1 <= s.t1 ? r : range_clip(r, s.t0, s.t1);
}

GNOMON_NAMESPACE_END
#endif
