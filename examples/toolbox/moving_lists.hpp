// The lists of a pack of texels while the rasterizer of motion works at them: ranges as they come, by packs, until they
// are laid out or resolved.
#pragma once

#include <gnomon/passes/backdrop.hpp>
#include <gnomon/passes/resolve.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moving_tiles.hpp"

namespace gnomon::toolbox {

// What a triangle adds to a pack of texels.
struct loose_pack {
    texel_lanes t0, t1, z0, z1;
    std::uint64_t exists; // a bit for each lane
    float id;
};

// Things one after the other, and room behind them that keeps what it has.
template <class T> class stack {
  public:
    std::size_t size() const { return size_; }
    std::span<const T> used() const { return std::span(room_).first(size_); }
    std::span<T> used() { return std::span(room_).first(size_); }
    void clear() { size_ = 0; }
    T* room_for(std::size_t count)
    {
        if (room_.size() < size_ + count) room_.resize(2 * (size_ + count));
        return &room_[size_];
    }
    void grow(std::size_t count) { size_ += count; }

  private:
    std::vector<T> room_;
    std::size_t size_ = 0;
};

// Lists of a pack of texels: ranges as they come, by packs, until they are laid out or resolved.
class texel_lists {
  public:
    // How many ranges there is room for.
    std::size_t room() const { return held_.size() + texel_pack::size * packs_.size(); }

    void clear()
    {
        clear_lists();
        backdrops_.fill({});
    }

    // Those that exist, a bit for each lane.
    GNOMON_INLINE void add(std::uint64_t exists, const range_pack& r, float id)
    {
        loose_pack& p = *packs_.room_for(1);
        packs_.grow(1);
        r.t0.store_unaligned(p.t0.data()), r.t1.store_unaligned(p.t1.data());
        r.z0.store_unaligned(p.z0.data()), r.z1.store_unaligned(p.z1.data());
        p.exists = exists, p.id = id;
    }

    // At the end of others, texel by texel, how many of each in counts.
    void append_to(stack<depth_time_range<float>>& all, std::span<std::uint32_t, texel_pack::size> counts) const
    {
        depth_time_range<float>*const begin = all.room_for(room() + 1), *end = begin;
        const std::span<const loose_pack> packs = packs_.used();
        auto held = held_.begin();
        for (std::size_t i = 0; i < texel_pack::size; ++i) {
            std::uint32_t count = held_counts_[i];
            if (count > 0) {
                end = std::copy_n(held, count, end);
                held += count;
            }
            // Without branches: what does not exist is overwritten.
            for (const loose_pack& p : packs) {
                const std::uint32_t exists = p.exists >> i & 1;
                *end = {p.t0[i], p.t1[i], p.z0[i], p.z1[i], p.id};
                end += exists, count += exists;
            }
            counts[i] = count;
        }
        all.grow(std::size_t(end - begin));
    }

    // They become what of them is in front. Without backdrops the farthest range that is always there waits outside of
    // the lists until the last call, since what comes may be behind it.
    void resolve(bool backdrops, bool last)
    {
        std::array<std::uint32_t, texel_pack::size> counts, held = held_counts_;
        lists_.clear();
        append_to(lists_, counts);
        clear_lists();
        std::span<const depth_time_range<float>> rest = lists_.used();
        for (std::size_t i = 0; i < texel_pack::size; rest = rest.subspan(counts[i++])) {
            std::span<const depth_time_range<float>> list = rest.first(counts[i]);
            if (!backdrops) list = filtered(list, held[i], backdrops_[i], last);
            spans_.resize(std::max(spans_.size(), resolve_capacity(list.size(), range_ids::surfaces)));
            const auto spans = resolve_ranges(list, std::span(spans_), range_ids::surfaces);
            for (const visible_span<float>& s : spans) held_.push_back(range_of(list, s));
            held_counts_[i] = static_cast<std::uint32_t>(spans.size());
        }
    }

  private:
    void clear_lists() { packs_.clear(), held_.clear(), held_counts_.fill(0); }

    // Of a list whose first ranges have been through the filter.
    std::span<const depth_time_range<float>> filtered(std::span<const depth_time_range<float>> list, std::size_t known,
                                                      backdrop_filter<float>& filter, bool last)
    {
        filtered_.assign(list.begin(), list.begin() + std::ptrdiff_t(known));
        for (const depth_time_range<float>& r : list.subspan(known))
            if (const auto listed = filter.add(r)) filtered_.push_back(*listed);
        if (last && filter.waiting() && !filter.is_backdrop()) filtered_.push_back(*filter.waiting());
        return filtered_;
    }

    stack<loose_pack> packs_;
    std::vector<depth_time_range<float>> held_; // resolved, texel by texel, before those in packs
    std::array<std::uint32_t, texel_pack::size> held_counts_{};
    std::array<backdrop_filter<float>, texel_pack::size> backdrops_;

    stack<depth_time_range<float>> lists_;
    std::vector<depth_time_range<float>> filtered_;
    std::vector<visible_span<float>> spans_;
};

} // namespace gnomon::toolbox
