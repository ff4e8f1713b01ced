// Many receivers at rest in a map of depth-time ranges, by packs. Lists are short and of unlike lengths, so lanes are
// not receivers but pairs of a receiver and a range in front of it: some hundred are fetched, all of them go through
// the kernel, and each receiver's are added up. Fetching many at once also keeps memory busy, of which a map takes more
// than any cache holds. The sums have the bits of static_shadow, one receiver at a time; where some of its texels say
// their totals, those are added first.
#ifndef GNOMON_SIMD_RANGE_LOOK_UP_HPP
#define GNOMON_SIMD_RANGE_LOOK_UP_HPP

#include "../passes/range_look_up.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace gnomon {

/// A receiver at rest and its texel position.
template <class T> struct placed_receiver {
    T x, y;
    static_receiver<T> state;
};

namespace detail {

/// Pairs that wait for the kernel; those of one receiver are one after the other.
template <class Pack> class loss_queue {
  public:
    using lane = lane_t<Pack>;

    explicit loss_queue(std::span<lane> sums) : sums_(sums) {}

    /// Pairs added from now on are of this receiver.
    void next(std::size_t receiver)
    {
        if (parts_ == ends_.size()) flush();
        receivers_[parts_] = receiver;
        ends_[parts_++] = count_;
    }

    /// What is never in front of the receiver is left behind.
    void add(const static_receiver<lane>& s, std::span<const depth_time_range<lane>> list)
    {
        for_each_counted(list, s.id, [&](const depth_time_range<lane>& r) {
            const std::array<lane, members> pair{s.depth, s.id, s.begin, s.end, s.weight, r.t0, r.t1, r.z0, r.z1, r.id};
            for (std::size_t k = 0; k < members; ++k) pairs_[k][count_] = pair[k];
            count_ += r.z0 < s.depth || r.z1 < s.depth;
            if (count_ == capacity) {
                const std::size_t receiver = receivers_[parts_ - 1];
                ends_[parts_ - 1] = count_;
                flush();
                next(receiver);
            }
        });
        ends_[parts_ - 1] = count_;
    }

    void flush()
    {
        for (std::size_t i = 0; i < count_; i += sizeof(Pack) / sizeof(lane)) {
            const auto at = [&](std::size_t k) { return Pack::load_unaligned(&pairs_[k][i]); };
            const static_receiver<Pack> receiver{at(0), at(1), at(2), at(3), at(4), Pack(lane(0))};
            const depth_time_range<Pack> range{at(5), at(6), at(7), at(8), at(9)};
            static_receiver_add_box(receiver, range).shadowed.store_unaligned(&lost_[i]);
        }
        for (std::size_t k = 0, i = 0; k < parts_; ++k) {
            lane sum = sums_[receivers_[k]];
            for (; i < ends_[k]; ++i) sum += lost_[i];
            sums_[receivers_[k]] = sum;
        }
        count_ = parts_ = 0;
    }

  private:
    static constexpr std::size_t members = 10, capacity = 512;
    static_assert(capacity * sizeof(lane) % sizeof(Pack) == 0);
    std::array<std::array<lane, capacity>, members> pairs_{};
    std::array<lane, capacity> lost_{};
    std::array<std::size_t, capacity / 8> receivers_{}, ends_{}; // of parts
    std::size_t count_ = 0, parts_ = 0;
    std::span<lane> sums_;
};

} // namespace detail

/// static_shadow(map, x, y, state, look_ups) of each receiver, for a shutter that opens and closes at once.
template <class Pack>
void static_shadows(const range_map<lane_t<Pack>>& map, std::span<const placed_receiver<lane_t<Pack>>> receivers,
                    std::span<lane_t<Pack>> shadows, int look_ups = 1)
{
    using lane = lane_t<Pack>;
    GNOMON_EXPECTS(shadows.size() == receivers.size(),
                   mismatch("static_shadows", "shadows.size()", shadows.size(), "receivers.size()", receivers.size()));
    GNOMON_EXPECTS(map.first.size() == map.texels(map.width, map.height) + 1,
                   mismatch("static_shadows", "map.first.size()", map.first.size(), "texels of the map, and one",
                            map.texels(map.width, map.height) + 1));
    GNOMON_EXPECTS(
        map.first.back() <= map.ranges.size(),
        mismatch("static_shadows", "map.first.back()", map.first.back(), "map.ranges.size()", map.ranges.size()));
    GNOMON_EXPECTS(map.totals.empty() || map.totals.size() + 1 == map.first.size(),
                   mismatch("static_shadows", "map.totals.size() + 1", map.totals.size() + 1, "map.first.size()",
                            map.first.size()));
    std::ranges::fill(shadows, lane(0));
    detail::loss_queue<Pack> queue(shadows);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        static_receiver<lane> state = receivers[i].state;
        bool queued = false;
        const auto add_list = [&](std::span<const depth_time_range<lane>> list) {
            if (!std::exchange(queued, true)) queue.next(i);
            queue.add(state, list);
        };
        detail::for_each_static_texel(map, receivers[i].x, receivers[i].y, look_ups,
                                      [&](lane weight, std::size_t texel) {
                                          state = static_receiver_weigh(state, weight);
                                          detail::add_static_texel(map, texel, state, add_list);
                                      });
        shadows[i] += state.shadowed; // of totals
    }
    queue.flush();
    for (lane& s : shadows) s = saturate_or_zero(s);
}

} // namespace gnomon
#endif
