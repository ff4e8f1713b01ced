// The lists of a pack of texels while the rasterizer of motion adds ranges to them, a range for each lane at a time.
// The list of a texel is a column of rows (simd/resolve.hpp). Finished lists are appended to a buffer, texel by texel.
#pragma once

#include "moving_tiles.hpp"

#include <gnomon/passes/range/backdrop.hpp>
#include <gnomon/simd/resolve.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::renderer {

struct range_pack {
    texel_pack t0, t1, z0, z1;
};

// A buffer to append to. Clearing it keeps its memory, and memory beyond its end keeps its contents.
template <class T> class append_buffer {
  public:
    std::size_t size() const { return size_; }
    std::span<const T> used() const { return std::span(room_).first(size_); }
    void clear() { size_ = 0; }
    // Room for `count` elements beyond the end; grow() adds them.
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

// Depths behind which everything is hidden, for each lane, while ranges are still added: for each of some equal parts
// of the shutter interval, the least of the farthest depths of the ranges that last for all of that part.
class hidden_depths {
  public:
    void clear()
    {
        depths_.fill(texel_pack(2.f));
        any_ = false;
    }

    // The lanes of `exists` in which the range may be in front.
    GNOMON_INLINE xsimd::batch_bool<float> may_be_seen(const xsimd::batch_bool<float>& exists,
                                                       const range_pack& r) const
    {
        if (!any_) return exists;
        const texel_pack nearest = gnomon_min(r.z0, r.z1);
        xsimd::batch_bool<float> seen(false);
        for (std::size_t k = 0; k < parts; ++k)
            seen = seen || (r.t0 < end(k) && begin(k) < r.t1 && nearest <= depths_[k]);
        return seen && exists;
    }

    // Notes a range that is added to the lists of these lanes.
    GNOMON_INLINE void add(const xsimd::batch_bool<float>& exists, const range_pack& r)
    {
        if (!gnomon_any(exists && texel_pack(part) <= r.t1 - r.t0)) return;
        any_ = true;
        const texel_pack farthest = gnomon_max(r.z0, r.z1);
        for (std::size_t k = 0; k < parts; ++k)
            depths_[k] = gnomon_select(exists && r.t0 <= begin(k) && end(k) <= r.t1, gnomon_min(depths_[k], farthest),
                                       depths_[k]);
    }

  private:
    static constexpr std::size_t parts = 8;
    static constexpr float part = 1 / float(parts);
    static texel_pack begin(std::size_t k) { return texel_pack(part * float(k)); }
    static texel_pack end(std::size_t k) { return texel_pack(part * float(k + 1)); }

    std::array<texel_pack, parts> depths_;
    bool any_ = false;
};

// The lists of a pack of texels.
class texel_lists {
  public:
    using range = depth_time_range<float>;
    using range_lanes = depth_time_range<texel_pack>;
    using lane_mask = xsimd::batch_bool<float>;

    // The number of ranges that the rows have room for.
    std::size_t room() const { return texel_pack::size * count_; }

    // Begins empty lists. Resolved lists hold the ranges in front. Without backdrops, the farthest range that is always
    // there is kept apart from its list: a range still to come may lie behind it.
    void clear(bool resolved, bool backdrops)
    {
        resolved_ = resolved, backdrops_ = backdrops;
        count_ = 0;
        if (!resolved) return;
        hidden_.clear();
        backdrop_ = {};
    }

    // Adds a range in the lanes of `exists`.
    GNOMON_INLINE void add(const lane_mask& exists, const range_pack& r, float id)
    {
        const range_lanes added{r.t0, r.t1, r.z0, r.z1, texel_pack(id)};
        if (resolved_) add_resolved(exists, added);
        else if (gnomon_any(exists)) put_in_new_row(exists, added);
    }

    // Appends the lists, texel by texel, and sets the sizes of the lists.
    void append_to(append_buffer<range>& all, std::span<std::uint32_t, texel_pack::size> sizes) const
    {
        range* end = all.room_for(room() + 1);
        for (std::size_t i = 0; i < texel_pack::size; ++i) {
            std::uint32_t count = 0;
            // Without branches: a range that does not exist is overwritten by the next one.
            for (std::size_t k = 0; k < count_; ++k) {
                const std::uint32_t exists = used_[k] >> i & 1;
                *end = rows_[k].range(i);
                end += exists, count += exists;
            }
            sizes[i] = count;
            all.grow(count);
        }
    }

    // Appends the parts in front, texel by texel, and sets the sizes of the lists. finish(list) may change a list in
    // place and returns the part of it that is kept.
    template <class Finish>
    void append_resolved_to(append_buffer<range>& all, std::span<std::uint32_t, texel_pack::size> sizes,
                            const Finish& finish)
    {
        if (!backdrops_) add_seen(backdrop_.rest().t0 < backdrop_.rest().t1, backdrop_.rest());
        resolve();
        for (std::size_t i = 0; i < texel_pack::size; ++i) {
            const std::span list(all.room_for(pieces_[i].size() + 1), pieces_[i].size());
            std::ranges::transform(pieces_[i], list.begin(), [&](const piece& p) { return rows_[p.row].range(i); });
            sizes[i] = static_cast<std::uint32_t>(finish(list).size());
            all.grow(sizes[i]);
        }
    }

    // Replaces the lists by their parts in front.
    void thin_out()
    {
        resolve();
        std::size_t longest = 0;
        for (const std::vector<piece>& some : pieces_) longest = std::max(longest, some.size());
        thinned_.resize(longest);
        for (std::size_t k = 0; k < longest; ++k) {
            used_[k] = 0;
            for (std::size_t i = 0; i < texel_pack::size; ++i) {
                const bool exists = k < pieces_[i].size();
                thinned_[k].set(i, exists ? rows_[pieces_[i][k].row].range(i) : range_empty(float(range_nothing)));
                used_[k] |= std::uint64_t(exists) << i;
            }
        }
        std::swap(rows_, thinned_);
        count_ = longest;
    }

  private:
    using row = range_row<texel_pack>;
    struct piece {
        float begin;
        std::uint32_t row;
    };

    GNOMON_INLINE void put_in_new_row(const lane_mask& exists, const range_lanes& r)
    {
        if (count_ >= rows_.size()) rows_.resize(count_ + 1);
        if (count_ >= used_.size()) used_.resize(rows_.size());
        used_[count_] = bits_of(exists);
        rows_[count_++].set(range_keep_if(exists, r));
    }

    [[gnu::noinline]] void add_resolved(lane_mask exists, const range_lanes& added)
    {
        if (backdrops_) return add_seen(exists, added);
        const range_lanes listed = backdrop_.add(range_keep_if(exists, added));
        add_seen(listed.t0 < listed.t1, listed);
    }

    // Adds a range to one of the last rows that is free in all of its lanes, or to a new row.
    GNOMON_INLINE void add_seen(const lane_mask& exists, const range_lanes& r)
    {
        const range_pack times{r.t0, r.t1, r.z0, r.z1};
        const lane_mask seen = hidden_.may_be_seen(exists, times);
        const std::uint64_t bits = bits_of(seen);
        if (bits == 0) return;
        hidden_.add(seen, times);
        constexpr std::size_t searched = 8;
        std::size_t k = count_ < searched ? 0 : count_ - searched;
        while (k < count_ && (used_[k] & bits) != 0) ++k;
        if (k == count_) return put_in_new_row(seen, r);
        used_[k] |= bits;
        rows_[k].set(range_select(seen, r, rows_[k].range()));
    }

    // Puts the parts in front into pieces_, for each lane in order of time.
    void resolve()
    {
        resolve_rows<texel_pack>(rows_, fronts_, count_);
        used_.resize(std::max(used_.size(), rows_.size()));
        for (std::vector<piece>& some : pieces_) some.clear();
        for (std::uint32_t k = 0; k < rows_.size(); ++k) {
            row& r = rows_[k];
            const front_row<texel_pack>& front = fronts_[k];
            const texel_pack begin = front.load(front.begin), end = front.load(front.end);
            const std::uint64_t seen = bits_of(begin < end);
            if (seen == 0) continue;
            r.set(range_clip(r.range(), begin, end));
            for_each_bit(seen, [&](std::size_t i) {
                std::vector<piece>& some = pieces_[i];
                some.push_back({r.t0[i], k});
                for (std::size_t j = some.size() - 1; j > 0 && some[j].begin < some[j - 1].begin; --j)
                    std::swap(some[j], some[j - 1]);
            });
        }
    }

    std::vector<row> rows_, thinned_; // the first count_ are in use
    std::vector<front_row<texel_pack>> fronts_;
    std::vector<std::uint64_t> used_; // for each row, a bit for each lane that has a range
    std::size_t count_ = 0;
    bool resolved_ = false, backdrops_ = true;
    hidden_depths hidden_;
    backdrop_filter<texel_pack> backdrop_;
    std::array<std::vector<piece>, texel_pack::size> pieces_;
};

} // namespace gnomon::renderer
