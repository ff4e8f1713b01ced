#include "stacks.hpp"

#include "evaluation/core/percentage_closer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon::evaluation {

namespace {

struct step {
    float depth;
    of_colours weight;
};

of_colours opacities(const glm::vec3& opacity)
{
    const auto of = [&](colour c) { return double(opacity_for(c, opacity)); };
    return {of(colour::grey), of(colour::red), of(colour::green), of(colour::blue)};
}

} // namespace

texel_stacks::texel_stacks(const translucent_occluders& occluders)
    : width_(occluders.opaque.width), height_(occluders.opaque.height)
{
    std::vector<step> steps;
    first_.push_back(0);
    for (std::size_t i = 0; i < occluders.opaque.pixels.size(); ++i) {
        steps.clear();
        for (const float z : occluders.opaque.pixels[i]) steps.push_back({z, of_colours(0.25)});
        for (const renderer::fragment& f : occluders.translucent(i)) {
            const of_colours alpha = opacities(f.opacity);
            for (step& behind : steps) behind.weight *= of_colours(1) - alpha;
            steps.push_back({f.depth, alpha});
        }
        std::ranges::sort(steps, {}, &step::depth);
        of_colours taken(0);
        for (const step& s : steps) {
            taken += s.weight;
            const bool again = first_.back() < depths_.size() && depths_.back() == s.depth;
            if (!again) depths_.push_back(s.depth), taken_.emplace_back();
            taken_.back() = glm::vec4(taken);
        }
        first_.push_back(static_cast<std::uint32_t>(depths_.size()));
    }
}

of_colours texel_stacks::intensity(int x, int y, float z_f) const
{
    const std::size_t texel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    const std::uint32_t first = first_[texel], last = first_[texel + 1];
    std::uint32_t before = first;
    for (std::uint32_t i = first; i < last; ++i) before += depths_[i] < z_f;
    return before == first ? of_colours(0) : of_colours(taken_[before - 1]);
}

// The filter region is that of percentage_closer_intensity.
of_colours texel_stacks::filtered_intensity(const map_receiver& where, std::span<const float> taps) const
{
    thread_local footprint<double> columns, rows;
    const double level = std::min(double(where.level), std::floor(std::log2(width_))), fine = std::floor(level);
    of_colours result(0);
    for (const int k : {0, 1}) {
        const double share = k == 0 ? 1 - (level - fine) : level - fine;
        if (!(share > 0)) continue;
        set_footprint(columns, where.u, static_cast<int>(fine) + k, width_, taps);
        set_footprint(rows, where.v, static_cast<int>(fine) + k, height_, taps);
        for (int j = 0; j < std::ssize(rows.weights); ++j) {
            of_colours row(0);
            for (int i = 0; i < std::ssize(columns.weights); ++i)
                row += columns.weights[static_cast<std::size_t>(i)] *
                       intensity(columns.first + i, rows.first + j, where.depth);
            result += share * rows.weights[static_cast<std::size_t>(j)] * row;
        }
    }
    return result;
}

} // namespace gnomon::evaluation
