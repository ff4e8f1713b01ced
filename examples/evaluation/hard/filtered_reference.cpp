// Percentage-closer filtering in double with the very weights of filtered maps: what differs is reconstruction error.
#include "evaluation/core/percentage_closer.hpp"
#include "shaded_stage.hpp"

#include <tbb/parallel_for.h>

namespace gnomon::evaluation {

namespace {

class filtered_reference final : public hard_reference {
  public:
    filtered_reference() : hard_reference("filtered", "percentage-closer filtering with the same weights", 10, true) {}

    std::vector<float> visibility(const shaded_stage& stage, std::span<const map_receiver> where) const override
    {
        std::vector<float> result(where.size());
        tbb::parallel_for(std::size_t(0), where.size(), [&](std::size_t i) {
            result[i] = 1 - static_cast<float>(percentage_closer_intensity<double>(stage.depths, where[i], stage.taps));
        });
        return result;
    }
};

const registered<filtered_reference> entry;

} // namespace

} // namespace gnomon::evaluation
