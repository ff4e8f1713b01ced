// Exact ranges and a cover for each texel, which look-ups read first: where the cover is one range, it stands for the
// list.
#include "covers.hpp"
#include "evaluation/motion/range_method.hpp"

namespace gnomon::evaluation {

namespace {

const registered<map_kind> covers_kind{
    map_kind{.id = "covers_and_range_lists", .label = "covers, and lists of ranges", .order = 130}};

class cover_first_ranges final : public range_method {
  public:
    cover_first_ranges()
        : range_method({.id = "cover_first_ranges",
                        .family = "covered_ranges",
                        .label = "exact ranges, cover first",
                        .order = 10},
                       {.variants = {{.receivers = {"stochastic"}, .tag = "covers", .pictured = false}}})
    {}

    range_shadow_map build(map_source& from, const evaluation::parameters&) const override
    {
        range_shadow_map result = unresolved_lists(label, from.resolution);
        result.kind = covers_kind->id;
        result.format = {"ranges_20b_covers_20b", "20 B ranges, 20 B covers"};
        cover(*from.map("exact_ranges"), result, [&](const uncut_range& found, const auto& list) {
            const bool stands_for_all = found.whole.id >= 0 && found.pieces == 1;
            result.texel_covers.push_back(stands_for_all ? found.whole : range_empty(-1.f));
            if (!stands_for_all) add_visible(found.whole, list, result.ranges);
        });
        return result;
    }
};

const registered<cover_first_ranges> entry;

} // namespace

} // namespace gnomon::evaluation
