#include "compact_spans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::evaluation {

namespace {

using range = depth_time_range<float>;

std::uint64_t id_code(float id)
{
    if (id == float(range_mixed)) return span_mixed;
    if (!(id >= 0 && id < float(span_mixed)))
        throw std::invalid_argument(fmt::format("packed spans: id {}, 0 to {} are possible", id, span_mixed - 1));
    return static_cast<std::uint64_t>(id);
}

// The last step that is no farther.
std::uint64_t depth_code(double z)
{
    return static_cast<std::uint64_t>(std::clamp(std::floor((z + 1) * (0.5 * span_depths)), 0.0, span_depths - 1));
}

// Depth along a range, and beyond its ends.
double depth_at(const range& r, double t)
{
    const double passed = (t - double(r.t0)) / (double(r.t1) - double(r.t0));
    return double(r.z0) + (double(r.z1) - double(r.z0)) * passed;
}

// Steps from begin to end, and the range whose they are.
struct stretch {
    double begin, end;
    std::size_t owner;
};

// Calls visit(range, time) for the ends of what of the ranges falls into it.
template <class Visit> void for_each_end(std::span<const range> list, const stretch& s, const Visit& visit)
{
    const double open = s.begin / span_times, close = s.end / span_times;
    for (const range& r : list) {
        if (double(r.t1) <= open || close <= double(r.t0)) continue;
        visit(r, std::max(double(r.t0), open));
        visit(r, std::min(double(r.t1), close));
    }
}

double nearest_in(std::span<const range> list, const stretch& s)
{
    double nearest = 1;
    for_each_end(list, s, [&](const range& r, double t) { nearest = std::min(nearest, depth_at(r, t)); });
    return nearest;
}

// A step in which ranges begin or end goes to the one that is nearest in it.
void add_stretch(std::span<const range> list, const stretch& s, std::vector<stretch>& to)
{
    if (!(s.begin < s.end)) return;
    if (!to.empty() && s.begin < to.back().end) {
        const auto alone = [&](std::size_t i) { return nearest_in(list.subspan(i, 1), {s.begin, s.end, i}); };
        if (!(alone(s.owner) < alone(to.back().owner))) return;
        to.pop_back();
    }
    to.push_back(s);
}

std::vector<stretch> stretches_of(std::span<const range> list)
{
    std::vector<stretch> steps, joined;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const double t0 = double(list[i].t0) * span_times, t1 = double(list[i].t1) * span_times;
        if (!(t0 < t1)) continue;
        const double inner0 = std::ceil(t0), inner1 = std::floor(t1);
        add_stretch(list, {std::floor(t0), inner0, i}, steps);
        add_stretch(list, {inner0, inner1, i}, steps);
        if (inner0 <= inner1) add_stretch(list, {inner1, std::ceil(t1), i}, steps);
    }
    for (const stretch& s : steps)
        if (!joined.empty() && joined.back().owner == s.owner && joined.back().end == s.begin)
            joined.back().end = s.end;
        else joined.push_back(s);
    return joined;
}

void add(double begin, double z0, double z1, std::uint64_t id, compact_spans& to)
{
    to.begins.push_back(static_cast<std::uint16_t>(begin));
    to.bodies.push_back(depth_code(z0) | depth_code(z1) << 20 | id << 40);
}

// The owner's line, moved as far in front as others need. A short one's would lead anywhere beyond its ends, and one
// that the near plane limits may not be moved: these become level.
void add_line(std::span<const range> list, const stretch& s, compact_spans& to)
{
    const range& own = list[s.owner];
    double ahead = 0;
    for_each_end(list, s,
                 [&](const range& r, double t) { ahead = std::max(ahead, depth_at(own, t) - depth_at(r, t)); });
    double z0 = depth_at(own, s.begin / span_times) - ahead, z1 = depth_at(own, s.end / span_times) - ahead;
    const bool brief = double(own.t1) - double(own.t0) < 4 / span_times;
    if (brief || std::min(z0, z1) < -1) z0 = z1 = nearest_in(list, s);
    add(s.begin, z0, z1, id_code(own.id), to);
}

} // namespace

std::size_t compact_spans::begin(std::size_t list) const
{
    return list < lists.size() ? groups[list / group] + lists[list] : begins.size();
}

std::size_t compact_spans::bytes() const
{
    return begins.size() * sizeof begins[0] + bodies.size() * sizeof bodies[0] + groups.size() * sizeof groups[0] +
           lists.size() * sizeof lists[0];
}

void compact_spans::clear() { begins.clear(), bodies.clear(), groups.clear(), lists.clear(); }

void compact_list(std::span<const range> resolved, compact_spans& to)
{
    if (to.lists.size() % compact_spans::group == 0) to.groups.push_back(static_cast<std::uint32_t>(to.begins.size()));
    const std::size_t begin = to.begins.size() - to.groups.back();
    if (begin > 0xffff) throw std::length_error("packed spans: more than 2^16 in 64 lists");
    to.lists.push_back(static_cast<std::uint16_t>(begin));
    double reached = 0;
    for (const stretch& s : stretches_of(resolved)) {
        if (reached < s.begin) add(reached, 1, 1, span_nothing, to);
        add_line(resolved, s, to);
        reached = s.end;
    }
    if (0 < reached && reached < span_times) add(reached, 1, 1, span_nothing, to);
}

} // namespace gnomon::evaluation
