// Receivers by samples in time along their paths.
#include "range_receiver.hpp"
#include "while_facing.hpp"

namespace gnomon::evaluation {

namespace {

float sampled_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return sampled_path_visibility(map, path); });
}

const registered<receiver_by<sampled_visibility>> entry{
    receiver_facts{.id = "sampled", .label = "sampled receivers", .order = 130, .marker = "square"}, false};

} // namespace

} // namespace gnomon::evaluation
