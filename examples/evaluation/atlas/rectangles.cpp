#include "rectangles.hpp"

namespace gnomon::evaluation {

double exact_blocker(std::span<const layer> region, float z_f)
{
    double weight = 0, sum = 0;
    for (const layer& l : region) {
        if (!(l.depth < z_f)) continue;
        weight += double(l.weight);
        sum += double(l.weight) * double(l.depth);
    }
    return weight > 0 ? sum / weight : double(z_f);
}

} // namespace gnomon::evaluation
