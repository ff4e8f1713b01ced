// A kind of receiver as the registry knows it: how the visibility of the light is found in a shadow map of ranges. A
// kind is one file in this folder.
#pragma once

#include "evaluation/core/method.hpp"
#include "evaluation/motion/light_receivers.hpp"
#include "evaluation/motion/range_maps.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace gnomon::evaluation {

class range_receiver : public receiver_kind {
  public:
    range_receiver(receiver_facts facts, bool one_time, evaluation::parameters with = {})
        : receiver_kind(std::move(facts)), at_samples(one_time), parameters(std::move(with))
    {}

    // The visibility of each receiver, 1 lit and 0 in shadow, over the time of its path.
    virtual void look_up(const range_shadow_map& map, std::span<const light_receiver> where,
                         std::span<float> visibility) const = 0;

    const bool at_samples; // for receivers at one time, one for each sample of the camera; for paths else
    const evaluation::parameters parameters;
};

// Visibility(map, receiver) for each.
template <auto Visibility> class receiver_by final : public range_receiver {
  public:
    using range_receiver::range_receiver;

    void look_up(const range_shadow_map& map, std::span<const light_receiver> where,
                 std::span<float> visibility) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i) visibility[i] = Visibility(map.map(), where[i]);
    }
};

// Throws std::invalid_argument where there is none of this id.
const range_receiver& range_receiver_of(std::string_view id);

} // namespace gnomon::evaluation
