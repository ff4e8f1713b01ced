#include "region.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon::evaluation {

double exact_intensity(std::span<const layer> region, float z_f)
{
    double sum = 0;
    for (const layer& l : region)
        if (l.depth < z_f) sum += double(l.weight);
    return sum;
}

filterable_method::channels filtered(const filterable_method& m, std::span<const layer> region)
{
    filterable_method::channels mean;
    for (const layer& l : region) {
        const filterable_method::channels texel = m.from_depth(l.depth);
        mean.resize(texel.size());
        for (std::size_t k = 0; k < texel.size(); ++k) mean[k] += l.weight * texel[k];
    }
    return m.store(mean);
}

double leak_at(const filterable_method& m, std::span<const layer> region, float z_f)
{
    return std::max(exact_intensity(region, z_f) - double(m.intensity(filtered(m, region), z_f)), 0.0);
}

} // namespace gnomon::evaluation
