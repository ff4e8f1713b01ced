// Lists resolved by packs against lists resolved one by one, and the withheld backdrop in every lane.
#include "motion/range/near_ties.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/backdrop.hpp>
#include <gnomon/simd/resolve.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

using list = std::vector<depth_time_range<float>>;

/// Long and short ranges, level and steep ones, some with common ends or ids, some hostile.
depth_time_range<float> any_range(bit_source& bits, bool coarse, bool hostile)
{
    const auto time = [&] { return float(coarse ? double(bits.below(9)) / 8 : bits.uniform(0, 1)); };
    const auto depth = [&] { return float(coarse ? double(bits.below(9)) / 4 - 1 : bits.uniform(-1, 1)); };
    const float t = bits.chance(0.2) ? 0 : time(), z = depth();
    depth_time_range<float> r =
        range_between(t, z, bits.chance(0.2) ? 1.f : time(), bits.chance(0.3) ? z : depth(), float(bits.below(40)));
    if (hostile && bits.chance(0.2)) (bits.chance(0.5) ? r.z0 : r.t1) = std::numeric_limits<float>::quiet_NaN();
    if (hostile && bits.chance(0.1)) std::swap(r.t0, r.t1);
    return r;
}

/// Lists resolved by packs, each in order of time.
template <class Pack> std::vector<list> resolved_together(const std::vector<list>& lists)
{
    std::size_t longest = 0;
    for (const list& some : lists) longest = std::max(longest, some.size());
    std::vector<range_row<Pack>> rows(longest);
    for (std::size_t k = 0; k < longest; ++k)
        for (std::size_t i = 0; i < lists.size(); ++i)
            rows[k].set(i, k < lists[i].size() ? lists[i][k] : range_empty(-1.f));
    std::vector<front_row<Pack>> fronts;
    resolve_rows<Pack>(rows, fronts, longest);
    std::vector<list> result(lists.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t i = 0; i < lists.size(); ++i)
            if (fronts[k].begin[i] < fronts[k].end[i])
                result[i].push_back(range_clip(rows[k].range(i), fronts[k].begin[i], fronts[k].end[i]));
    for (list& some : result) std::ranges::sort(some, {}, &depth_time_range<float>::t0);
    return result;
}

list resolved_alone(const list& ranges)
{
    std::vector<visible_span<float>> room(resolve_capacity(ranges.size(), range_ids::surfaces));
    list result;
    for (const visible_span<float>& s : resolve_ranges<float>(ranges, room, range_ids::surfaces))
        result.push_back(range_of<float>(ranges, s));
    return result;
}

/// A list in which neighbouring parts of one range are joined.
list joined(const list& spans)
{
    list result;
    for (const auto& s : spans)
        if (!result.empty() && result.back().t1 == s.t0 && result.back().id == s.id && result.back().z1 == s.z0)
            result.back().t1 = s.t1, result.back().z1 = s.z1;
        else result.push_back(s);
    return result;
}

} // namespace

TEST_CASE_TEMPLATE("resolve_rows: the spans of resolve_ranges in every lane", Pack, xsimd::batch<float>)
{
    bit_source bits(91);
    std::int64_t same = 0, asked = 0, apart = 0;
    for (std::int64_t n = 0; n < test::effort(4'000); ++n) {
        std::vector<list> lists(Pack::size);
        const std::size_t most = std::size_t(1) << bits.below(6);
        const bool coarse = bits.chance(0.3), hostile = bits.chance(0.2);
        for (list& some : lists)
            for (std::size_t k = bits.below(most + 1); k > 0; --k) some.push_back(any_range(bits, coarse, hostile));
        const std::vector<list> together = resolved_together<Pack>(lists);
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const list found = joined(together[i]), expected = joined(resolved_alone(lists[i]));
            ++asked;
            apart += expected.size() > lists[i].size();
            for (std::size_t k = 1; k < found.size(); ++k) REQUIRE(found[k - 1].t1 <= found[k].t0);
            const auto equal = [](const auto& a, const auto& b) {
                return a.t0 == b.t0 && a.t1 == b.t1 && a.id == b.id && std::abs(a.z0 - b.z0) <= 1e-6f &&
                       std::abs(a.z1 - b.z1) <= 1e-6f;
            };
            same += std::ranges::equal(found, expected, equal);
        }
    }
    // The order of comparing decides where three lines meet within the tie.
    CHECK(asked - same <= asked / 1000);
    CHECK(apart > 0);
}

// At any time the range in front of all others, within a tie.
TEST_CASE_TEMPLATE("resolve_rows: at any time the depth in front", Pack, xsimd::batch<float>)
{
    bit_source bits(92);
    std::int64_t there = 0, far = 0;
    for (std::int64_t n = 0; n < test::effort(2'000); ++n) {
        std::vector<list> lists(Pack::size);
        const bool coarse = bits.chance(0.3), together_within_ties = bits.chance(0.3);
        for (list& some : lists)
            for (std::size_t k = bits.below(25); k > 0; --k) {
                depth_time_range<float> r = any_range(bits, coarse, false);
                if (together_within_ties) r.z0 *= 1e-5f, r.z1 *= 1e-5f;
                some.push_back(r);
            }
        const std::vector<list> together = resolved_together<Pack>(lists);
        for (std::size_t i = 0; i < lists.size(); ++i)
            for (int k = 0; k < 8; ++k) {
                const auto t = static_cast<float>(bits.uniform(0, 1));
                const auto front = [&](const list& some) {
                    float depth = 2;
                    for (const auto& r : some)
                        if (r.t0 <= t && t < r.t1) depth = std::min(depth, range_depth(r, t));
                    return depth;
                };
                const auto beside_an_end = [&](const auto& r) {
                    return std::abs(r.t0 - t) < 1e-5f || std::abs(r.t1 - t) < 1e-5f;
                };
                if (std::ranges::any_of(lists[i], beside_an_end)) continue;
                const float expected = front(lists[i]), found = front(together[i]);
                REQUIRE((expected == 2) == (found == 2));
                const double ties = double(std::abs(found - expected)) / resolve_tie<double>;
                REQUIRE(ties <= 1.01 * double(lists[i].size()));
                there += expected<2, far += ties> 1.01;
            }
    }
    CHECK(there > 10 * test::effort(2'000));
    CHECK(far < there / 100); // hardly ever is it a second tie
}

TEST_CASE("resolve_rows: for n ranges within a tie a climber finds the front at most n - 1 ties behind")
{
    using pack = gnomon::pack<xsimd::batch<float>>;
    for (const std::size_t n : {2u, 3u, 6u}) {
        const test::summit top = test::climb_ties<float>(
            n, n, [](const list& all) { return resolved_together<pack>(std::vector<list>(pack::size, all))[0]; });
        CHECK(top.score <= 1.01 * double(n - 1));
        CHECK(top.score > 0.5);
    }
}

TEST_CASE("backdrop_filter: every lane has the result of a single list")
{
    using pack = gnomon::pack<xsimd::batch<float>>;
    bit_source bits(93);
    std::int64_t backdrops = 0;
    for (std::int64_t n = 0; n < test::effort(2'000); ++n) {
        backdrop_filter<pack> together;
        std::vector<backdrop_filter<float>> alone(pack::size);
        for (std::size_t k = bits.below(8); k > 0; --k) {
            range_row<pack> row;
            for (std::size_t i = 0; i < pack::size; ++i) row.set(i, any_range(bits, true, true));
            range_row<pack> listed;
            listed.set(together.add(row.range()));
            for (std::size_t i = 0; i < pack::size; ++i) {
                const auto expected = alone[i].add(row.range(i)), found = listed.range(i);
                REQUIRE((found.t0 == expected.t0 || found.t0 != found.t0));
                REQUIRE(found.id == expected.id);
            }
        }
        range_row<pack> rest;
        rest.set(together.rest());
        for (std::size_t i = 0; i < pack::size; ++i) {
            REQUIRE(rest.range(i).id == alone[i].rest().id);
            backdrops += alone[i].is_backdrop();
        }
    }
    CHECK(backdrops > test::effort(2'000) / 20);
}
