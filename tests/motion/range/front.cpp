// The lower envelope of lists of any length, span by span: the front at many times, and the spans of resolve_ranges.
#include "list_cases.hpp"

#include <gnomon/passes/range/resolve.hpp>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

// All spans, in order; those without a range, too.
template <class T> ranges<T> walk(const ranges<T>& all)
{
    ranges<T> spans;
    for (T t = T(0); t < T(1);) {
        range_front<T> state = range_front_begin(t);
        for (const auto& r : all) state = range_front_compare(state, r);
        for (const auto& r : all) state = range_front_limit(state, r);
        spans.push_back(range_front_span(state));
        REQUIRE(spans.back().t0 == t);
        REQUIRE(spans.back().t1 > t);
        t = spans.back().t1;
        REQUIRE(spans.size() <= (all.size() + 1) * (all.size() + 2) / 2);
    }
    REQUIRE(spans.back().t1 == T(1));
    return spans;
}

template <class T> const range<T>& at(const ranges<T>& spans, double t)
{
    return *std::find_if(spans.begin(), spans.end(), [&](const auto& s) { return t < double(s.t1); });
}

} // namespace

TEST_CASE_TEMPLATE("the walk finds the front of long lists", T, float, double)
{
    bit_source bits(17);
    std::int64_t gaps = 0;
    for (std::int64_t i = 0; i < effort(200); ++i) {
        const auto all = any_ranges<T>(i % 20 == 0 ? 1 : 10 + bits.below(40), bits);
        const auto spans = walk(all);
        for (int k = 0; k < 200; ++k) {
            const double t = (k + 0.5) / 200;
            const double front = front_at(all, t);
            const auto& span = at(spans, t);
            REQUIRE((front == nowhere) == (double(span.id) == range_nothing));
            gaps += front == nowhere;
            if (front != nowhere) REQUIRE(std::abs(depth_at(span, t) - front) <= slack<T>(all, t));
        }
    }
    CHECK(gaps > 0);
}

TEST_CASE("the walk agrees with resolve_ranges, whose spans come from insertion")
{
    CHECK(rc::check([] {
        bit_source bits(*rc::gen::arbitrary<std::uint32_t>());
        const auto all = any_ranges<double>(1 + std::size_t(bits.below(24)), bits);
        std::vector<visible_span<double>> room(resolve_capacity(all.size(), range_ids::surfaces));
        const std::span<const range<double>> list(all);
        ranges<double> inserted;
        for (const auto& s : resolve_ranges(list, std::span(room), range_ids::surfaces))
            inserted.push_back(range_of(list, s));
        const auto spans = walk(all);
        for (int k = 0; k < 100; ++k) {
            const double t = *rc::gen::map(rc::gen::arbitrary<std::uint32_t>(), [](auto n) { return n * 0x1p-32; });
            const double z = front_at(inserted, t);
            const auto& span = at(spans, t);
            RC_ASSERT((z == nowhere) == (span.id == range_nothing));
            if (z == nowhere) continue;
            // A tie may leave the range in front that is up to resolve_tie behind, for each of the others.
            const double allowed = slack<double>(all, t) + double(all.size()) * resolve_tie<double>;
            RC_ASSERT(std::abs(depth_at(span, t) - z) <= allowed);
        }
    }));
}
