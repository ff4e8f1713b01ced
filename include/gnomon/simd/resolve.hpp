// The lists of several texels resolved at once, one list in each lane of a pack: passes/range/resolve.hpp for packs,
// for ids of surfaces. A row holds one range of each list. Every range is compared with every other range of its texel:
// while both last, one occludes the other throughout, or up to the crossing of their lines. Occluded time is removed
// from a range's begin or end, without branches. If the middle of a range is occluded, the part behind it becomes a
// further row.
#ifndef GNOMON_SIMD_RESOLVE_HPP
#define GNOMON_SIMD_RESOLVE_HPP

#include "../passes/range/resolve.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace gnomon {

/// One number for each lane.
template <class Pack> using pack_lanes = std::array<lane_t<Pack>, sizeof(Pack) / sizeof(lane_t<Pack>)>;

/// The k-th range of each list; an empty one if a list is shorter.
template <class Pack> struct range_row {
    alignas(Pack) pack_lanes<Pack> t0, t1, z0, z1, id;

    depth_time_range<Pack> range() const
    {
        const auto load = [](const pack_lanes<Pack>& x) { return Pack::load_unaligned(x.data()); };
        return {load(t0), load(t1), load(z0), load(z1), load(id)};
    }
    depth_time_range<lane_t<Pack>> range(std::size_t i) const { return {t0[i], t1[i], z0[i], z1[i], id[i]}; }

    void set(const depth_time_range<Pack>& r)
    {
        r.t0.store_unaligned(t0.data()), r.t1.store_unaligned(t1.data());
        r.z0.store_unaligned(z0.data()), r.z1.store_unaligned(z1.data()), r.id.store_unaligned(id.data());
    }
    void set(std::size_t i, const depth_time_range<lane_t<Pack>>& r)
    {
        t0[i] = r.t0, t1[i] = r.t1, z0[i] = r.z0, z1[i] = r.z1, id[i] = r.id;
    }
};

/// The times from begin to end at which a row is in front, none unless begin < end; its slope; and the place in the
/// list of the range that it is a part of.
template <class Pack> struct front_row {
    alignas(Pack) pack_lanes<Pack> begin, end, slope, place;

    static Pack load(const pack_lanes<Pack>& x) { return Pack::load_unaligned(x.data()); }
};

namespace detail {

/// A row in registers.
template <class Pack> struct loaded_row {
    depth_time_range<Pack> range;
    Pack begin, end, slope, place;

    loaded_row(const range_row<Pack>& r, const front_row<Pack>& f)
        : range(r.range()), begin(f.load(f.begin)), end(f.load(f.end)), slope(f.load(f.slope)), place(f.load(f.place))
    {}

    void store(front_row<Pack>& to) const
    {
        begin.store_unaligned(to.begin.data()), end.store_unaligned(to.end.data());
    }
    Pack depth(const Pack& t) const { return range.z0 + (t - range.t0) * slope; }
};

/// The times at which each of two ranges is occluded by the other.
template <class Pack> struct hidden_times {
    Pack a_from, a_to, b_from, b_to;
};

/// The times at which each of two rows is occluded by the other (see front_resolver::order_of).
template <class Pack> hidden_times<Pack> compare_rows(const loaded_row<Pack>& a, const loaded_row<Pack>& b)
{
    const Pack begin = gnomon_max(a.range.t0, b.range.t0), end = gnomon_min(a.range.t1, b.range.t1);
    const Pack none(lane_t<Pack>(0)), tie(resolve_tie<lane_t<Pack>>);
    const auto distance = [&](const Pack& t) { return a.depth(t) - b.depth(t); };
    const auto outside_tie = [&](const Pack& d) { return gnomon_select(gnomon_abs(d) <= tie, none, d); };
    const Pack exact_early = distance(begin), exact_late = distance(end), sum = exact_early + exact_late;
    const Pack early = outside_tie(exact_early), late = outside_tie(exact_late);
    const auto level = early == none && late == none;
    const auto b_first_by_id = b.range.id < a.range.id || (b.range.id == a.range.id && b.place < a.place);
    const auto b_all =
        (level && (none < sum || (sum == none && b_first_by_id))) || (!level && none <= early && none <= late);
    const auto a_all = !b_all && early <= none && late <= none;
    Pack change = gnomon_select(a_all, end, begin);
    const auto crossing = !(a_all || b_all);
    if (gnomon_any(crossing)) {
        const Pack meeting = begin + (end - begin) * (exact_early / (exact_early - exact_late));
        change = gnomon_select(crossing, gnomon_max(gnomon_min(meeting, end), begin), change);
    }
    // Up to the change one of the two is in front, and from then on the other.
    const auto a_first = a_all || b_all || early < none;
    return {gnomon_select(a_first, change, begin), gnomon_select(a_first, end, change),
            gnomon_select(a_first, begin, change), gnomon_select(a_first, change, end)};
}

} // namespace detail

/// Find the visible parts of lists whose first ranges are the first `count` rows, and write them into as many fronts.
/// rows and fronts are vectors. Rows are added for ranges that fall apart; rows beyond the first `count` are removed at
/// the start. A range without duration, or with a depth that is not finite, is in front of nothing.
template <class Pack, class Rows, class Fronts> void resolve_rows(Rows& rows, Fronts& fronts, std::size_t count)
{
    using lane = lane_t<Pack>;
    const Pack zero(lane(0)), one(lane(1));
    rows.resize(count), fronts.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        const depth_time_range<Pack> r = rows[k].range();
        const auto some = r.t0 < r.t1 && r.z0 - r.z0 == zero && r.z1 - r.z1 == zero;
        gnomon_select(some, r.t0, one).store_unaligned(fronts[k].begin.data());
        gnomon_select(some, r.t1, zero).store_unaligned(fronts[k].end.data());
        ((r.z1 - r.z0) / (r.t1 - r.t0)).store_unaligned(fronts[k].slope.data());
        fronts[k].place.fill(lane(k));
    }
    std::array<std::size_t, sizeof(Pack) / sizeof(lane)> ends; // of the rows added for each list
    ends.fill(count);
    std::size_t compared = 1;
    // Make a part of row k a row of its own, to be compared later.
    const auto add = [&](std::size_t i, std::size_t k, lane begin, lane end) {
        const std::size_t to = (std::max)(ends[i], compared + 1);
        ends[i] = to + 1;
        if (to == rows.size()) {
            rows.emplace_back().set(range_empty(Pack(lane(range_nothing))));
            auto& front = fronts.emplace_back();
            front.begin.fill(lane(1)), front.end.fill(lane(0));
        }
        rows[to].set(i, rows[k].range(i));
        fronts[to].place[i] = fronts[k].place[i], fronts[to].slope[i] = fronts[k].slope[i];
        fronts[to].begin[i] = begin, fronts[to].end[i] = end;
    };
    // Remove from a row the time at which the other one occludes it, where `some` is set. An occluded part occludes
    // nothing, so that three lines that meet within rounding cannot occlude one another.
    const auto hide = [&](std::size_t k, detail::loaded_row<Pack>& row, const auto& some, const Pack& from,
                          const Pack& to) {
        const auto during = some && from < to;
        const auto middle = during && row.begin < from && to < row.end;
        if (gnomon_any(middle)) {
            pack_lanes<Pack> parts, begin, end;
            gnomon_select(middle, one, zero).store_unaligned(parts.data());
            to.store_unaligned(begin.data()), row.end.store_unaligned(end.data());
            for (std::size_t i = 0; i < parts.size(); ++i)
                if (parts[i] > 0) add(i, k, begin[i], end[i]);
        }
        const auto first = during && from <= row.begin;
        row.end = gnomon_select(during && !first, gnomon_min(row.end, from), row.end);
        row.begin = gnomon_select(first, gnomon_max(row.begin, to), row.begin);
    };
    for (; compared < rows.size(); ++compared) {
        detail::loaded_row<Pack> b(rows[compared], fronts[compared]);
        for (std::size_t i = 0; i < compared; ++i) {
            const Pack begin = fronts[i].load(fronts[i].begin), end = fronts[i].load(fronts[i].end);
            const auto both = gnomon_max(begin, b.begin) < gnomon_min(end, b.end);
            if (!gnomon_any(both)) continue;
            detail::loaded_row<Pack> a(rows[i], fronts[i]);
            const detail::hidden_times<Pack> h = detail::compare_rows(a, b);
            const Pack b_from = gnomon_max(h.b_from, a.begin), b_to = gnomon_min(h.b_to, a.end);
            hide(i, a, both, gnomon_max(h.a_from, b.begin), gnomon_min(h.a_to, b.end));
            hide(compared, b, both, b_from, b_to);
            a.store(fronts[i]);
            if (!gnomon_any(b.begin < b.end)) break;
        }
        b.store(fronts[compared]);
    }
}

} // namespace gnomon
#endif
