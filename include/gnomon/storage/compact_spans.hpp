// A storage form of resolved lists of depth-time ranges: 10 bytes for each span instead of 20 for each range. A span
// ends where the next span of its list begins, or at time 1, so it stores a single time: 16 bits of time, 20 bits of
// depth at either end, and 24 bits of the id. Time without a range is a span with the id compact_nothing. Lists lie one
// after the other. The begins of lists are in two tables: a 32 bit number for each group of 64 lists, and 16 bits for
// each list.
//
//     for (const depth_time_range<float>& r : spans[i])   // all ranges of list i; a span of nothing is an empty range
//
// Any bits in the spans read as ranges that are empty or have times in [0, 1] and depths in [-1, 1]. The pass that
// writes spans (passes/range/compact.hpp) states how far they are from the ranges.
#ifndef GNOMON_STORAGE_COMPACT_SPANS_HPP
#define GNOMON_STORAGE_COMPACT_SPANS_HPP

#include "../motion/range/range.h"
#include "../portable/cpp_only.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

GNOMON_NAMESPACE_BEGIN

inline constexpr int compact_times = 1 << 16;              // steps of the shutter interval
inline constexpr int compact_depths = 1 << 20;             // steps from the near to the far plane
inline constexpr std::uint32_t compact_nothing = 0xffffff; // id of a span without a range
inline constexpr std::uint32_t compact_mixed = 0xfffffe;   // id of a range of several surfaces, range_mixed

/// Largest code of a depth that is not behind z by more than 2^-53, for z in [-1, 1]; clamped outside.
/// NaN: the code farthest from the light.
inline std::uint64_t compact_depth_code(double z)
{
    const double steps = std::floor((z + 1) * (0.5 * compact_depths)), last = compact_depths - 1.0;
    return static_cast<std::uint64_t>(steps < last ? (std::max)(steps, 0.0) : last);
}

/// Depth of a code in the low 20 bits, exact in float.
inline float compact_depth(std::uint64_t code)
{
    return static_cast<float>(static_cast<std::int32_t>(code & (compact_depths - 1))) * (2.0f / compact_depths) - 1;
}

/// Body of a span: depths at its begin and end, rounded towards the light, and the code of its id.
inline std::uint64_t compact_body(double z0, double z1, std::uint32_t id)
{
    return compact_depth_code(z0) | compact_depth_code(z1) << 20 | std::uint64_t(id) << 40;
}

/// The spans of one list, read as ranges.
class compact_list {
  public:
    compact_list() = default;
    compact_list(const std::uint16_t* begins, const std::uint64_t* bodies, std::size_t size)
        : begins_(begins), bodies_(bodies), size_(size)
    {}

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const std::uint16_t* begin_of(std::size_t n) const { return begins_ + n; }
    const std::uint64_t* body_of(std::size_t n) const { return bodies_ + n; }

    /// The n-th span as a range; an empty range for a span of nothing.
    depth_time_range<float> operator[](std::size_t n) const
    {
        const std::uint64_t body = bodies_[n];
        const auto id = static_cast<std::uint32_t>(body >> 40);
        if (id == compact_nothing) return range_empty(float(range_nothing));
        const float t0 = static_cast<float>(begins_[n]) * (1.0f / compact_times);
        const float t1 = n + 1 < size_ ? static_cast<float>(begins_[n + 1]) * (1.0f / compact_times) : 1;
        const float whole = static_cast<float>(static_cast<std::int32_t>(id));
        return {t0, t1, compact_depth(body), compact_depth(body >> 20),
                id == compact_mixed ? float(range_mixed) : whole};
    }

    class iterator {
      public:
        using value_type = depth_time_range<float>;
        using difference_type = std::ptrdiff_t;

        iterator() = default;
        iterator(const compact_list& list, std::size_t n) : list_(&list), n_(n) {}
        value_type operator*() const { return (*list_)[n_]; }
        iterator& operator++()
        {
            ++n_;
            return *this;
        }
        iterator operator++(int) { return {*list_, n_++}; }
        bool operator==(const iterator& other) const { return n_ == other.n_; }

      private:
        const compact_list* list_ = nullptr;
        std::size_t n_ = 0;
    };
    iterator begin() const { return {*this, 0}; }
    iterator end() const { return {*this, size_}; }

  private:
    const std::uint16_t* begins_ = nullptr;
    const std::uint64_t* bodies_ = nullptr;
    std::size_t size_ = 0;
};

/// Compact lists in the caller's memory. List i begins at span groups[i / 64] + lists[i], and ends where the next list
/// begins, or after the last span.
struct compact_spans {
    static constexpr std::size_t group = 64;

    std::span<const std::uint16_t> begins;
    std::span<const std::uint64_t>
        bodies; // depth at begin in the low 20 bits, at end in the next 20, id in the high 24
    std::span<const std::uint32_t> groups;
    std::span<const std::uint16_t> lists;

    std::size_t begin(std::size_t i) const { return i < lists.size() ? groups[i / group] + lists[i] : begins.size(); }
    compact_list operator[](std::size_t i) const
    {
        const std::size_t first = begin(i);
        return {begins.data() + first, bodies.data() + first, begin(i + 1) - first};
    }

    /// Memory of all spans and tables.
    std::size_t bytes() const
    {
        return begins.size_bytes() + bodies.size_bytes() + groups.size_bytes() + lists.size_bytes();
    }
};

GNOMON_NAMESPACE_END
#endif
