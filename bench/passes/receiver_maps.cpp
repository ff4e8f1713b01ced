// Receivers in a map of ranges that no cache holds: squares cross the map at random, and receivers are among them. The
// baseline is the fold of the kernels, tap after tap and list after list; that of compact lists is the plain lists.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/compact.hpp>
#include <gnomon/passes/range/look_up.hpp>
#include <gnomon/passes/range/resolve.hpp>

namespace gnomon::bench {

namespace {

constexpr std::size_t side = 1024, squares = 6000;
constexpr float widest = 24, longest = 60;              // half the side of a square, and its path, in texels
constexpr std::size_t receivers = 65536, at_once = 256; // receivers, and how many are looked up at a time

/// The times between which a point is inside a square along one axis, where the centre of the square moves from a to b.
std::pair<float, float> times_inside(float point, float a, float b, float half)
{
    if (a == b) return std::abs(point - a) <= half ? std::pair(0.f, 1.f) : std::pair(1.f, 0.f);
    const float t = (point - half - a) / (b - a), u = (point + half - a) / (b - a);
    return {std::max(std::min(t, u), 0.f), std::min(std::max(t, u), 1.f)};
}

/// A box shutter for which look-ups take no shortcuts.
struct folded_box : box_shutter {};

class squares_map {
  public:
    squares_map()
    {
        test::bit_source bits(1);
        const auto number = [&](float low, float high) {
            return static_cast<float>(bits.uniform(double(low), double(high)));
        };
        std::vector<std::uint32_t> texels;
        std::vector<depth_time_range<float>> ranges;
        for (std::size_t id = 0; id < squares; ++id) {
            const float x0 = number(0, side), y0 = number(0, side), half = number(4, widest);
            const float x1 = x0 + number(-longest, longest), y1 = y0 + number(-longest, longest);
            const float z0 = number(-0.9f, 0.9f), z1 = z0 + number(-0.1f, 0.1f);
            const auto first = [&](float a, float b) { return std::size_t(std::max(std::min(a, b) - half, 0.f)); };
            const auto last = [&](float a, float b) {
                return std::size_t(std::clamp(std::max(a, b) + half, 0.f, side - 1.f));
            };
            for (std::size_t y = first(y0, y1); y <= last(y0, y1); ++y)
                for (std::size_t x = first(x0, x1); x <= last(x0, x1); ++x) {
                    const auto across = times_inside(float(x) + 0.5f, x0, x1, half);
                    const auto along = times_inside(float(y) + 0.5f, y0, y1, half);
                    const float t0 = std::max(across.first, along.first), t1 = std::min(across.second, along.second);
                    if (!(t0 < t1)) continue;
                    texels.push_back(static_cast<std::uint32_t>(range_map<float>::texel(side, x, y)));
                    ranges.push_back(range_clip(depth_time_range<float>{0, 1, z0, z1, static_cast<float>(id)}, t0, t1));
                }
        }
        std::vector<std::uint32_t> first(range_map<float>::texels(side, side) + 1);
        std::vector<depth_time_range<float>> sorted(ranges.size());
        sort_into_lists<float>(texels, ranges, first, sorted);
        std::vector<visible_span<float>> room;
        const range_map<float> all{side, side, first, sorted};
        for (std::size_t i = 0; i + 1 < first.size(); ++i) {
            const auto list = all[i];
            room.resize(std::max(room.size(), resolve_capacity(list.size(), range_ids::surfaces)));
            first_.push_back(static_cast<std::uint32_t>(ranges_.size()));
            for (const auto& s : resolve_ranges<float>(list, room, range_ids::surfaces))
                ranges_.push_back(range_of<float>(list, s));
        }
        first_.push_back(static_cast<std::uint32_t>(ranges_.size()));
        totals_.resize(first.size() - 1);
        set_summaries(lists(), std::span(totals_), range_ids::surfaces);
        begins_.resize(compact_capacity(lists())), bodies_.resize(begins_.size());
        list_begins_.resize(totals_.size()), groups_.resize(totals_.size() / compact_spans::group);
        compact_ = compact_ranges(lists(), {begins_, bodies_, groups_, list_begins_});
        for (std::size_t i = 0; i < receivers; ++i) {
            const float x = number(0, side), y = number(0, side), z = number(-1, 1);
            const float u = x + number(-longest, longest), v = y + number(-longest, longest);
            const receiver_path<float> path{{0, 1, z, z + number(-0.1f, 0.1f), float(squares)}, x, y, 1, u, v, 1};
            paths_.push_back(path);
            placed_.push_back({x, y, static_receiver_begin(z, float(squares), 0.f, 1.f)});
            const auto shifted = receiver_path_shift(path, -0.5f, -0.5f);
            auto sweep = texel_sweep_over(shifted, -1.f, -1.f, float(side), float(side));
            for (++cells_; sweep.t_end < sweep.t_last; ++cells_) sweep = texel_sweep_next(sweep);
        }
        shadows_.resize(receivers);
    }

    range_map<float> lists() const { return {side, side, first_, ranges_}; }
    compact_range_map compact() const { return {side, side, compact_}; }
    compact_range_map compact_with_totals() const { return {side, side, compact_, totals_}; }
    range_map<float> with_totals() const { return {side, side, first_, ranges_, totals_}; }

    /// The look-up of moving receivers with a box shutter, counted by cells of their paths.
    template <class Map, class... Shutter> work moving(const Map& map, const Shutter&... shutter)
    {
        return each(cells_ / receivers, [=, this](std::size_t i) {
            shadows_[i] = moving_intensity(map, paths_[i], 0.f, 1.f, 1, shutter...);
        });
    }
    /// The look-up of moving receivers by the fold.
    work moving_by_fold() { return moving(lists(), folded_box{}); }

    /// The look-up of static receivers, many at a time.
    template <class Map> work statically(const Map& map)
    {
        return {[=, this, begin = start()]() mutable {
                    const auto next = std::span(placed_).subspan(begin, at_once);
                    static_intensities<float>(map, next, std::span(shadows_).subspan(begin, at_once));
                    begin = (begin + at_once) % receivers;
                },
                double(at_once)};
    }
    /// The look-up of static receivers by the fold.
    work static_by_fold()
    {
        return each(1, [this](std::size_t i) {
            shadows_[i] = static_intensity(lists(), placed_[i].x, placed_[i].y, placed_[i].state, 1, folded_box{});
        });
    }

  private:
    /// The work of `look` for each receiver. Works start at different receivers, so that none finds the data of another
    /// in a cache.
    template <class Look> work each(double parts, const Look& look)
    {
        return {[=, begin = start()]() mutable {
                    for (std::size_t i = begin; i < begin + at_once; ++i) look(i);
                    begin = (begin + at_once) % receivers;
                },
                parts * double(at_once)};
    }

    std::size_t start() { return starts_++ * (receivers / 2) % receivers; }

    std::size_t starts_ = 0;
    std::vector<std::uint32_t> first_;
    std::vector<depth_time_range<float>> ranges_;
    std::vector<range_summary<float>> totals_;
    std::vector<std::uint16_t> begins_, list_begins_;
    std::vector<std::uint64_t> bodies_;
    std::vector<std::uint32_t> groups_;
    compact_spans compact_;
    std::vector<receiver_path<float>> paths_;
    std::vector<placed_receiver<float>> placed_;
    std::vector<float> shadows_;
    double cells_ = 0;
};

squares_map& scene()
{
    static squares_map map;
    return map;
}

[[maybe_unused]] const bool registered =
    add_comparison(
        "receivers/a cell of a path/fold", [] { return scene().moving_by_fold(); },
        [] { return scene().moving_by_fold(); }) &&
    add_comparison(
        "receivers/a cell of a path/lists", [] { return scene().moving(scene().lists()); },
        [] { return scene().moving_by_fold(); }) &&
    add_comparison(
        "receivers/a cell of a path/totals", [] { return scene().moving(scene().with_totals()); },
        [] { return scene().moving_by_fold(); }) &&
    add_comparison(
        "receivers/static/fold", [] { return scene().static_by_fold(); }, [] { return scene().static_by_fold(); }) &&
    add_comparison(
        "receivers/static/lists", [] { return scene().statically(scene().lists()); },
        [] { return scene().static_by_fold(); }) &&
    add_comparison(
        "receivers/static/totals", [] { return scene().statically(scene().with_totals()); },
        [] { return scene().static_by_fold(); }) &&
    add_comparison(
        "receivers/static/compact against lists", [] { return scene().statically(scene().compact()); },
        [] { return scene().statically(scene().lists()); }) &&
    add_comparison(
        "receivers/static/compact with summaries against lists with summaries",
        [] { return scene().statically(scene().compact_with_totals()); },
        [] { return scene().statically(scene().with_totals()); });

} // namespace

} // namespace gnomon::bench
