// A resolved list in 10 bytes for each span instead of 20. Of two spans one after the other the first ends where the
// second begins, so that one time is enough: 16 bits of it, 20 for the depth at either end and 24 for the id. Time that
// nothing covers is a span without a surface.
//
// Rounding is to the safe side: what a list shadows it shadows as packed, at all times. The one exception are the two
// surfaces of a change of front, which may take the other's place within 2^-16 of the shutter, and none shadows itself.
// Nothing is there more than 2^-16 of the shutter before its begin or after its end. Depth is nearer by 2^-19 and by
// what it changes by in 2^-16 of the shutter, at most; of spans shorter than 4 times 2^-16 in 6 times that.
#pragma once

#include <gnomon/motion/range/range.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

inline constexpr double span_times = 65536;             // steps of the shutter
inline constexpr double span_depths = 1 << 20;          // steps from near to far plane
inline constexpr std::uint32_t span_nothing = 0xffffff; // ids without a surface,
inline constexpr std::uint32_t span_mixed = 0xfffffe;   // of several surfaces

struct compact_spans {
    static constexpr std::size_t group = 64; // lists whose begins are told from one number

    std::vector<std::uint16_t> begins;
    std::vector<std::uint64_t> bodies; // depth at begin in the low 20 bits, at end in the next 20, id in the high 24
    std::vector<std::uint32_t> groups; // where the first list of each begins
    std::vector<std::uint16_t> lists;  // where each list begins, from there

    std::size_t begin(std::size_t list) const;
    std::size_t bytes() const;
    void clear();
};

// One more list, in order of time and without overlaps; ids are below span_mixed, or range_mixed. Throws
// std::invalid_argument for others, std::length_error where a group has more than 2^16 spans.
void compact_list(std::span<const depth_time_range<float>> resolved, compact_spans& to);

// Calls visit(range) for each of a list.
template <class Visit> void for_each_span(const compact_spans& from, std::size_t list, const Visit& visit)
{
    constexpr std::uint64_t mask = (std::uint64_t(1) << 20) - 1;
    const auto depth = [&](std::uint64_t code) { return float(double(code & mask) * (2 / span_depths) - 1); };
    const std::size_t end = from.begin(list + 1);
    for (std::size_t i = from.begin(list); i < end; ++i) {
        const std::uint64_t body = from.bodies[i], id = body >> 40;
        if (id == span_nothing) continue;
        const double t0 = from.begins[i] / span_times, t1 = i + 1 < end ? from.begins[i + 1] / span_times : 1;
        visit(depth_time_range<float>{float(t0), float(t1), depth(body), depth(body >> 20),
                                      id == span_mixed ? float(range_mixed) : float(id)});
    }
}

} // namespace gnomon::evaluation
