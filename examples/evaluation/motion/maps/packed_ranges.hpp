// Packed maps of resolved ranges, told apart by what is packed. They are measured with static receivers and against
// cubes.
#pragma once

#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/packed_map.hpp"

#include <string>
#include <utility>

namespace gnomon::evaluation {

class packed_ranges final : public motion_method {
  public:
    packed_ranges(method_facts facts, std::string of) : motion_method(std::move(facts)), of_(std::move(of)) {}

    void measure(motion_view&, std::span<const std::string>, const outcome_sink&) const override {}
    std::optional<map_facts> costs(map_source& from) const override { return packed_map_of(*from.map(of_)); }

  private:
    std::string of_; // id of the method that is packed
};

} // namespace gnomon::evaluation
