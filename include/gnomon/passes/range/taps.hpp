// Reading of maps of ranges that no cache holds, for look-ups. Taps, the texels that a filter reads, are queued. Then
// the summaries of all taps are loaded together, then the begins of the lists that summaries leave open, then these
// lists. So memory is waited for once for each step of a queue, not once for each tap.
#ifndef GNOMON_PASSES_RANGE_TAPS_HPP
#define GNOMON_PASSES_RANGE_TAPS_HPP

#include "../../motion/receiver/moving_receiver.h"
#include "../../motion/receiver/static_receiver.h"
#include "map.hpp"
#include "shutters.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

GNOMON_NAMESPACE_BEGIN

/// A static receiver and its texel position.
template <class T> struct placed_receiver {
    T x, y;
    static_receiver<T> state;
};

/// Largest number of look-ups along each axis.
inline constexpr int maximum_look_ups = 4096;

namespace detail {

inline void expect_look_ups(std::string_view pass, int look_ups)
{
    GNOMON_EXPECTS(0 < look_ups && look_ups <= maximum_look_ups,
                   std::string("gnomon: ").append(pass) + ": look_ups is " + std::to_string(look_ups) + ", but 1 to " +
                       std::to_string(maximum_look_ups) + " are possible");
}

/// Call visit(i, j, texel) for those of the (K + 1) x (K + 1) texels from (column, row) on that are in the map, K =
/// look_ups.
template <class Map, class T, class Visit>
void for_each_texel(const Map& map, T column, T row, int look_ups, const Visit& visit)
{
    const T width = T(map.width), height = T(map.height);
    for (int j = 0; j <= look_ups; ++j) {
        const T y = row + T(j);
        if (!(y >= 0 && y < height)) continue; // a NaN is outside
        for (int i = 0; i <= look_ups; ++i) {
            const T x = column + T(i);
            if (!(x >= 0 && x < width)) continue;
            visit(i, j, map.texel(map.width, std::size_t(x), std::size_t(y)));
        }
    }
}

/// Call visit(weight, texel) for the texels of a filter around (x, y).
template <class Map, class T, class Visit>
void for_each_static_texel(const Map& map, T x, T y, int look_ups, const Visit& visit)
{
    const T k = T(look_ups), left = x - T(0.5) * k, top = y - T(0.5) * k;
    const T column = texel_below(left), row = texel_below(top), u = left - column, v = top - row;
    for_each_texel(map, column, row, look_ups, [&](int i, int j, std::size_t texel) {
        visit(texel_weight(u, T(i), k) * texel_weight(v, T(j), k), texel);
    });
}

/// Call visit(range) for the ranges of a resolved list that count for a receiver with this id.
template <class List, class T, class Visit> void for_each_counted(const List& list, T id, const Visit& visit)
{
    depth_time_range<T> front = range_empty(T(range_nothing));
    for (const depth_time_range<T>& r : list) {
        if (!range_is_second_layer(front, r)) front = r;
        else if (!(front.id == id)) continue;
        visit(r);
    }
}

/// Add the light that a static receiver loses to a list, for a box shutter. If the exposure is the whole shutter
/// interval, ranges that are in front at all times, as most are, need no division; the bits are those of the kernels.
template <class T, class List> void add_list_box(static_receiver<T>& state, const List& list)
{
    const bool whole = state.begin == 0 && state.end == 1;
    for_each_counted(list, state.id, [&](const depth_time_range<T>& r) {
        const bool begins = r.z0 < state.depth, ends = r.z1 < state.depth;
        if (!begins && !ends) return;
        if (!(whole && begins && ends)) {
            state = add_range(state, r, box_shutter{});
            return;
        }
        const T share = saturate_or_zero(r.t1) - clamp_or_high(r.t0, T(0), T(1)); // at most 0 if either is NaN
        state = static_receiver_add(state, receiver_lost_light(r, state.id, T(0), share));
    });
}

/// Add a summary to a static receiver and return true, if the summary decides; else return false.
template <class T> bool add_summary_box(static_receiver<T>& state, const range_summary<T>& summary)
{
    if (receiver_is_in_front(state.depth, summary) > 0) return true;
    static_receiver<T> exposed = state;
    const bool always = summary.shadowed >= 1 && 0 <= state.begin && state.begin < state.end && state.end <= 1;
    if (always) exposed.begin = 0, exposed.end = 1; // occluded at all times, hence in any exposure
    if (!(static_receiver_is_behind(exposed, summary) > 0)) return false;
    state = static_receiver_add(state, summary.shadowed);
    return true;
}

/// Taps of static receivers; the light that each loses is added up in shadows.
template <class T, class Map> class static_taps {
  public:
    static_taps(const Map& map, std::span<const placed_receiver<T>> receivers, std::span<T> shadows)
        : map_(map), receivers_(receivers), shadows_(shadows)
    {}

    void add(std::size_t receiver, T weight, std::size_t texel)
    {
        if (count_ == taps_.size()) drain();
        taps_[count_++] = {receiver, texel, weight};
        if (map_.summaries.empty()) map_.prefetch_begin(texel);
        else prefetch(&map_.summaries[texel]);
    }

    /// Add the light lost in all queued taps.
    void drain()
    {
        const auto used = [&] { return std::span(taps_).first(count_); };
        const auto change = [&](const tap& t, const auto& add) {
            static_receiver<T> state = static_receiver_set_weight(receivers_[t.receiver].state, t.weight);
            state.shadowed = shadows_[t.receiver];
            const bool changed = add(state);
            if (changed) shadows_[t.receiver] = state.shadowed;
            return changed;
        };
        if (!map_.summaries.empty()) {
            std::size_t left = 0;
            for (const tap& t : used()) {
                const range_summary<T>& summary = map_.summaries[t.texel];
                const bool decided =
                    change(t, [&](static_receiver<T>& state) { return add_summary_box(state, summary); });
                taps_[left] = t;
                left += !decided;
            }
            count_ = left;
            for (const tap& t : used()) map_.prefetch_begin(t.texel);
        }
        for (const tap& t : used()) map_.prefetch_list(t.texel);
        for (const tap& t : used())
            change(t, [&](static_receiver<T>& state) { return add_list_box(state, map_[t.texel]), true; });
        count_ = 0;
    }

  private:
    struct tap {
        std::size_t receiver, texel;
        T weight;
    };
    const Map& map_;
    std::span<const placed_receiver<T>> receivers_;
    std::span<T> shadows_;
    std::array<tap, 256> taps_;
    std::size_t count_ = 0;
};

/// The part of a receiver's path between two borders of texel centres: from time t0 to time t1, at the positions (u0,
/// v0) and (u1, v1) in the cell at these times, between two depths, with the share of the exposure's light in that
/// time.
template <class T> struct receiver_cell {
    T column, row, t0, t1, u0, v0, u1, v1, nearest, farthest, share;
};

/// Taps of a moving receiver, for a box shutter: the fold of moving_receiver.h, in which ranges that touch count as
/// one, and ranges that occlude the receiver throughout a cell need no division.
template <class T, class Map> class moving_taps {
  public:
    moving_taps(const Map& map, const moving_receiver<T>& state, int look_ups)
        : map_(map), state_(state), look_ups_(look_ups)
    {}

    void add(const receiver_cell<T>& cell)
    {
        if (cell_count_ == cells_.size()) drain();
        cells_[cell_count_++] = cell;
        for_each_texel(map_, cell.column, cell.row, look_ups_, [&](int i, int j, std::size_t texel) {
            if (count_ == room) {
                drain();
                cells_[cell_count_++] = cell;
            }
            taps_[count_++] = {&cells_[cell_count_ - 1], texel, i, j, false, {}, 0, nullptr};
            map_.prefetch_begin(texel);
            if (!map_.summaries.empty()) prefetch(&map_.summaries[texel]);
        });
    }

    /// Shadow intensity. Call after all cells.
    T end()
    {
        drain();
        const T look_ups = T(look_ups_);
        state_.shadowed = state_.shadowed / (look_ups * look_ups);
        return moving_receiver_end(state_);
    }

  private:
    struct tap {
        const receiver_cell<T>* cell;
        std::size_t texel;
        int i, j;
        bool single; // its list has no second layer
        decltype(std::declval<const Map&>()[0]) list;
        std::size_t at;  // place in the list where reading begins, then where it ended
        const tap* same; // an earlier tap of the same texel, in the cell before, or none
    };
    static constexpr std::size_t room = 64; // memory that is loaded but not read yet has to fit in the nearest cache

    /// Weight of texel i along one axis: K times texel_weight.
    T weight(T u, int i) const { return i == 0 ? 1 - u : i < look_ups_ ? T(1) : u; }
    void set_weights(const tap& t)
    {
        const receiver_cell<T>& c = *t.cell;
        state_.t0 = c.t0, state_.t1 = c.t1;
        state_.u0 = weight(c.u0, t.i), state_.v0 = weight(c.v0, t.j);
        state_.u1 = weight(c.u1, t.i), state_.v1 = weight(c.v1, t.j);
    }

    /// Add the light lost while the receiver is occluded from one time to another. Throughout an exposed cell this is
    /// the mean of the product of two lines.
    void occlude(const receiver_cell<T>& c, T from, T to)
    {
        if (from == c.t0 && to == c.t1 && state_.begin <= from && to <= state_.end) {
            const T ends = state_.u0 * state_.v0 + state_.u1 * state_.v1;
            const T mixed = state_.u0 * state_.v1 + state_.u1 * state_.v0;
            state_.shadowed += c.share * (2 * (2 * ends + mixed) * T(receiver_twelfth));
        } else {
            const depth_time_range<T> hidden{from, to, T(0), T(0), T(range_nothing)};
            state_.shadowed += moving_receiver_filtered_light(state_, hidden, state_.begin, state_.end, T(1), T(0));
        }
    }

    /// Add a summary and return true, if it decides; else return false.
    bool add_summary(const tap& t, const range_summary<T>& summary)
    {
        if (receiver_is_in_front(t.cell->farthest, summary) > 0) return true;
        const auto behind = static_receiver_begin(t.cell->nearest, state_.depth.id, T(0), T(1));
        const bool always = summary.shadowed >= 1 && t.cell->t0 >= 0 && t.cell->t1 <= 1;
        if (!(always && static_receiver_is_behind(behind, summary) > 0)) return false;
        set_weights(t);
        occlude(*t.cell, t.cell->t0, t.cell->t1);
        return true;
    }

    /// Find the list of tap k of the queue, and begin to load its range at the cell's time, by an estimate of its
    /// place.
    void find_list(std::size_t k)
    {
        tap& t = taps_[k];
        const std::size_t reach = t.single ? std::min<std::size_t>(k, 5) : 0; // K = 1: the taps of the cell before
        for (std::size_t back = 1; back <= reach; ++back)
            if (const tap& before = taps_[k - back]; before.texel == t.texel) {
                t.list = before.list, t.same = &before;
                return;
            }
        t.list = map_[t.texel];
        if (t.list.empty()) return;
        const T place = T(t.list.size()) * saturate_or_zero(t.cell->t0);
        t.at = t.single ? (std::min)(std::size_t(place), t.list.size() - 1) : 0;
        map_.prefetch_range(t.list, t.at);
    }

    void add_list(tap& t)
    {
        if (t.list.empty()) return;
        set_weights(t);
        const receiver_cell<T>& c = *t.cell;
        depth_time_range<T> front = range_empty(T(range_nothing));
        T from = c.t0, to = c.t0; // of ranges that touch
        std::size_t n = t.same ? t.same->at : t.at;
        while (n > 0 && c.t0 < t.list[n].t0) --n;
        for (; n < t.list.size(); ++n) {
            const depth_time_range<T>& r = t.list[n];
            if (!(r.t0 < r.t1)) continue;
            if (!(r.t0 < c.t1)) break; // and so are all that follow
            if (!range_is_second_layer(front, r)) front = r;
            else if (!(front.id == state_.depth.id)) continue;
            const bool behind = c.farthest <= r.z0 && c.farthest <= r.z1;
            if (c.t0 < r.t1 && !behind && !(r.id == state_.depth.id)) {
                if (!(r.z0 < c.nearest && r.z1 < c.nearest)) state_ = add_filtered_range(state_, r, box_shutter{});
                else {
                    if (r.t0 > to) {
                        if (from < to) occlude(c, from, to);
                        from = r.t0;
                    }
                    to = (std::min)(r.t1, c.t1);
                }
            }
            if (t.single && c.t1 <= r.t1) break; // the next range begins later
        }
        t.at = (std::min)(n, t.list.size() - 1);
        if (from < to) occlude(c, from, to);
    }

    void drain()
    {
        const auto used = [&] { return std::span(taps_).first(count_); };
        if (!map_.summaries.empty()) {
            std::size_t left = 0;
            for (const tap& t : used()) {
                const range_summary<T>& summary = map_.summaries[t.texel];
                if (add_summary(t, summary)) continue;
                taps_[left] = t;
                taps_[left++].single = summary.id == T(range_nothing);
            }
            count_ = left;
        }
        for (std::size_t k = 0; k < count_; ++k) find_list(k);
        for (std::size_t k = 0; k < count_; ++k) add_list(taps_[k]);
        count_ = cell_count_ = 0;
    }

    const Map& map_;
    moving_receiver<T> state_;
    int look_ups_;
    std::array<receiver_cell<T>, room / 4> cells_;
    std::array<tap, room> taps_;
    std::size_t count_ = 0, cell_count_ = 0;
};

} // namespace detail
GNOMON_NAMESPACE_END
#endif
