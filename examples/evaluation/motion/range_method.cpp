#include "range_method.hpp"

#include "evaluation/core/timing.hpp"
#include "receivers/range_receiver.hpp"

#include <algorithm>

namespace gnomon::evaluation {

bool is_set(const parameters& some, const std::string& name)
{
    const auto found = some.find(name);
    return found != some.end() && found->second != 0;
}

report_row row_of(const method& m, const map_facts& map)
{
    report_row row = row_of(m);
    row.map = map.kind;
    row.format = map.format.id;
    row.parameters = map.parameters;
    row.label = map.label;
    row.bytes_per_texel = map.bytes_per_texel();
    row.map_bytes = double(map.bytes);
    row.build_ms = map.build_ms;
    return row;
}

void range_method::measure(motion_view& view, std::span<const std::string> tags, const outcome_sink& add) const
{
    for (const range_variant& v : of_ranges_.variants) {
        if (!v.tag.empty() && std::ranges::count(tags, v.tag) == 0) continue;
        const auto built = view.maps.map(id, v.parameters);
        const path_receivers& paths = view.receivers(is_set(v.parameters, "surfaces"));
        for (const std::string& one : v.receivers) {
            const range_receiver& receiver = range_receiver_of(one);
            const auto& where = receiver.at_samples ? view.sample_receivers : paths.biased;
            motion_outcome found{.row = row_of(*this, *built),
                                 .seen = receiver.at_samples ? view.samples : view.paths,
                                 .visibility = std::vector<float>(where.size()),
                                 .format = built->format.label,
                                 .pictured = v.pictured};
            const double spent = least_seconds([&] { receiver.look_up(*built, where, found.visibility); });
            if (!receiver.at_samples) {
                found.unbiased.resize(paths.unbiased.size());
                receiver.look_up(*built, paths.unbiased, found.unbiased);
            }
            found.row.receiver = receiver.id;
            found.row.parameters.insert(receiver.parameters.begin(), receiver.parameters.end());
            found.row.label += ", " + receiver.label;
            found.row.ns_per_receiver = view.per_receiver(spent);
            add(found);
        }
    }
}

std::optional<map_facts> range_method::costs(map_source& from) const
{
    if (!of_ranges_.curve) return {};
    return *from.map(id);
}

} // namespace gnomon::evaluation
