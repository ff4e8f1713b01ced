// Exact ranges, one after the other, into lists of a fixed capacity, 4, 8 or 16, resolved in the end. Full lists merge
// two ranges: the pair of the least cost by area, or by the weights of Gribel et al. 2010; into a line in front of
// both, or into one between their outer ends. The time is the sum of what all threads have spent.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/range_method.hpp"

#include <gnomon/comparators/interval_list.h>
#include <gnomon/motion/range/range_list.h>
#include <gnomon/passes/range/part.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

namespace {

using pack = gnomon::pack<xsimd::batch<float>>;
using lanes = std::array<float, pack::size>;

depth_time_range<float> range_in_lane(const depth_time_range<pack>& r, std::size_t i)
{
    return {r.t0.get(i), r.t1.get(i), r.z0.get(i), r.z1.get(i), r.id.get(i)};
}

// Costs of pairs, and which line replaces a pair.
struct merging {
    interval_weights<float> weights;
    bool conservative;

    template <int M> range_list<pack, M> insert(const range_list<pack, M>& list, const depth_time_range<pack>& r) const
    {
        if (weights.area > 0 && conservative) return range_list_insert(list, r);
        const interval_weights<pack> w{pack(weights.area), pack(weights.gap), pack(weights.depth), pack(weights.slope),
                                       pack(weights.duration)};
        return interval_list_insert(list, r, w, conservative ? 1.f : 0.f);
    }
};

constexpr interval_weights<float> area_alone{1, 0, 0, 0, 0};
constexpr interval_weights<float> after_gribel{0, 1, 1, 0.125f, 0.25f}; // chosen by hand

merging merging_of(const evaluation::parameters& how)
{
    const auto plain = how.find("conservative");
    return {is_set(how, "weights") ? after_gribel : area_alone, plain == how.end() || plain->second != 0};
}

// The lists of some texels, a pack of them at a time.
template <int N> struct listed_texels {
    std::vector<depth_time_range<float>> ranges;
    std::vector<std::uint32_t> counts;
    double spent = 0, time_added = 0, depth_added = 0;
    float most_time_added = 0, most_depth_added = 0;

    void add(const range_map<float>& from, std::size_t texel, const merging& how)
    {
        std::array<std::span<const depth_time_range<float>>, pack::size> lists;
        std::size_t longest = 0;
        for (std::size_t i = 0; i < pack::size; ++i) {
            parted_[i].assign(from[texel + i].begin(), from[texel + i].end());
            part_neighbours(std::span(parted_[i]));
            lists[i] = parted_[i];
            longest = std::max(longest, lists[i].size());
        }
        if (longest == 0) {
            counts.insert(counts.end(), pack::size, 0);
            return;
        }
        // A range is at most 3 spans and two are at most 6, so that smaller lists hold them as well.
        if constexpr (N > 4)
            if (longest <= 1) return add_lists<4>(lists, longest, how);
        if constexpr (N > 8)
            if (longest <= 2) return add_lists<8>(lists, longest, how);
        add_lists<N>(lists, longest, how);
    }

  private:
    std::array<std::vector<depth_time_range<float>>, pack::size> parted_;

    template <int M>
    void add_lists(const std::array<std::span<const depth_time_range<float>>, pack::size>& lists, std::size_t longest,
                   const merging& how)
    {
        range_list<pack, M> list = range_list_make<pack, M>(range_empty(pack(0.f)));
        for (std::size_t k = 0; k < longest; ++k) {
            std::array<lanes, 5> r;
            for (std::size_t i = 0; i < pack::size; ++i) {
                const auto one = k < lists[i].size() ? lists[i][k] : range_empty(0.f);
                r[0][i] = one.t0, r[1][i] = one.t1, r[2][i] = one.z0, r[3][i] = one.z1, r[4][i] = one.id;
            }
            const auto packed = [&](std::size_t member) { return pack::load_unaligned(r[member].data()); };
            list = how.insert(list, {packed(0), packed(1), packed(2), packed(3), packed(4)});
        }
        list = range_list_resolve(list);
        for (std::size_t i = 0; i < pack::size; ++i) {
            const std::size_t before = ranges.size();
            for (int k = 0; k < M; ++k) {
                const auto span = range_in_lane(list.ranges[k], i);
                if (span.t0 < span.t1) ranges.push_back(span);
            }
            counts.push_back(std::uint32_t(ranges.size() - before));
            const float time = list.time_added.get(i), depth = list.depth_added.get(i);
            time_added += double(time), depth_added += double(depth);
            most_time_added = std::max(most_time_added, time), most_depth_added = std::max(most_depth_added, depth);
        }
    }
};

// Chunks of texels, and what all threads have spent on them.
template <int N> double list(const range_map<float>& from, const merging& how, std::vector<listed_texels<N>>& chunks)
{
    constexpr std::size_t chunk = range_map<float>::texels_per_tile;
    static_assert(chunk % pack::size == 0);
    const std::size_t texels = from.first.size() - 1;
    chunks.assign((texels + chunk - 1) / chunk, {});
    tbb::parallel_for(std::size_t(0), chunks.size(), [&](std::size_t c) {
        chunks[c].spent = seconds([&] {
            for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, texels); i += pack::size)
                chunks[c].add(from, i, how);
        });
    });
    double spent = 0;
    for (const listed_texels<N>& some : chunks) spent += some.spent;
    return spent;
}

template <int N> range_shadow_map listed(const range_shadow_map& exact, const merging& how)
{
    range_shadow_map result = unresolved_lists(fmt::format("interval lists of {}", N), exact.resolution);
    result.kind = resolved_lists_kind->id;
    result.parameters["capacity"] = N;
    std::vector<listed_texels<N>> chunks;
    const double spent = least_of([&] { return list<N>(exact.map(), how, chunks); });
    result.first = {0};
    double time_added = 0, depth_added = 0;
    for (const listed_texels<N>& some : chunks) {
        for (const std::uint32_t count : some.counts) result.first.push_back(result.first.back() + count);
        result.ranges.insert(result.ranges.end(), some.ranges.begin(), some.ranges.end());
        time_added += some.time_added, depth_added += some.depth_added;
        result.most_time_added = std::max(result.most_time_added, some.most_time_added);
        result.most_depth_added = std::max(result.most_depth_added, some.most_depth_added);
    }
    const std::size_t texels = result.first.size() - 1;
    result.mean_time_added = float(time_added / double(texels));
    result.mean_depth_added = float(depth_added / double(texels));
    result.build_ms = exact.build_ms + 1e3 * spent;
    result.bytes = list_bytes(result);
    result.building_bytes = texels * (std::size_t(N) * sizeof(depth_time_range<float>) + 2 * sizeof(float));
    result.pairs = exact.pairs;
    result.resolved = true;
    return result;
}

range_shadow_map listed(const range_shadow_map& exact, double capacity, const merging& how)
{
    if (capacity == 4) return listed<4>(exact, how);
    if (capacity == 8) return listed<8>(exact, how);
    if (capacity == 16) return listed<16>(exact, how);
    throw std::invalid_argument(fmt::format("interval lists: capacity {}, 4, 8 and 16 are possible", capacity));
}

std::vector<range_variant> variants()
{
    std::vector<range_variant> result;
    for (const double n : {4, 8, 16}) result.push_back({.parameters = {{"capacity", n}}, .receivers = {"analytic"}});
    for (const double n : {4, 8, 16})
        result.push_back({.parameters = {{"capacity", n}, {"surfaces", 1}},
                          .receivers = {"analytic"},
                          .tag = "surfaces",
                          .pictured = false});
    const auto add_merging = [&](parameters how) {
        result.push_back(
            {.parameters = std::move(how), .receivers = {"analytic"}, .tag = "surfaces", .pictured = false});
    };
    for (const double n : {4, 8, 16}) add_merging({{"capacity", n}, {"weights", 1}, {"conservative", 0}});
    add_merging({{"capacity", 4}, {"conservative", 0}}); // one of the two alone
    add_merging({{"capacity", 4}, {"weights", 1}});
    return result;
}

class interval_lists final : public range_method {
  public:
    interval_lists()
        : range_method({.id = "interval_lists", .family = "interval_lists", .label = "interval lists"},
                       {.variants = variants()})
    {}

    range_shadow_map build(map_source& from, const evaluation::parameters& how) const override
    {
        const bool surfaces = is_set(how, "surfaces");
        const auto exact =
            from.map("exact_ranges", surfaces ? evaluation::parameters{{"surfaces", 1}} : evaluation::parameters{});
        const merging merge = merging_of(how);
        range_shadow_map result = listed(*exact, how.at("capacity"), merge);
        if (surfaces) result.parameters["surfaces"] = 1, result.label += ", ids of surfaces";
        if (is_set(how, "weights")) result.parameters["weights"] = 1, result.label += ", merged by weights";
        if (!merge.conservative) result.parameters["conservative"] = 0, result.label += ", not conservative";
        return result;
    }
};

const registered<family> lists{
    family{.id = "interval_lists", .label = "interval lists", .order = 170, .colour = "#e377c2"}};
const registered<interval_lists> entry;

} // namespace

} // namespace gnomon::evaluation
