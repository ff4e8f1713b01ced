// Layers of a tile and the parts of those that are divided by motion: the samples that belong to each, and how these move.
#ifndef GNOMON_PASSES_LAYER_DIVISION_HPP
#define GNOMON_PASSES_LAYER_DIVISION_HPP

#include "layer_window.hpp"

GNOMON_NAMESPACE_BEGIN
namespace detail {

inline constexpr float layer_least_spread = 0.5f; // texels: layers whose motions differ by less are whole

/// Opacity and weight of samples for layer number `layer`.
struct whole_layer {
    layer_cuts<float> cuts;
    float layer;

    layer_share<float> share(const sample_batch& s, std::size_t k) const
    {
        return layer_share_of(layer_of(s.middle[k], cuts), layer);
    }
};

/// Opacity and weight of samples for part 0 or 1 of a divided layer.
struct layer_part {
    whole_layer of;
    layer_division division;
    float part, centre;

    layer_share<float> share(const sample_batch& s, std::size_t k) const
    {
        const layer_cuts<float> keys{division.cut, float(layer_no_cut), float(layer_no_cut)};
        const float its_part = layer_of(layer_direction_key(division.direction, s[k]), keys);
        return layer_share_of_part(layer_of(s.middle[k], of.cuts), of.layer, its_part, part, s.middle[k], centre);
    }
};

/// The motions of one layer in lanes, as of layer_motion_sums.
struct motion_lanes {
    static constexpr std::size_t count = sample_batch::lanes;
    using lanes = std::array<float, count>;
    layer_motion_sums<float> sums; // first
    lanes x{}, y{}, z{}, square{}, square_z{}, known{}, least, greatest, least_d, greatest_d;

    explicit motion_lanes(const stochastic_sample<float>& first) : sums(layer_motion_begin(first))
    {
        least.fill(sums.least);
        greatest.fill(sums.greatest);
        least_d.fill(sums.least_d);
        greatest_d.fill(sums.greatest_d);
    }
    /// Add samples n to n + count - 1 of a batch that are in the layer, as of layer_motion_add.
    void add(const sample_batch& s, std::size_t n, const auto& layer)
    {
        for (std::size_t k = 0; k < count; ++k) {
            const float d_x = s.d_x[n + k], d_y = s.d_y[n + k], d_z = s.d_z[n + k];
            const float middle = s.z[n + k] + (0.5f - s.t[n + k]) * d_z;
            const bool counts = 0 < layer.share(s, n + k).opacity;
            const float dx = counts ? d_x - sums.first_x : 0;
            const float dy = counts ? d_y - sums.first_y : 0;
            const float dz = counts ? d_z - sums.first_z : 0;
            x[k] += dx;
            y[k] += dy;
            z[k] += dz;
            square[k] += dx * dx + dy * dy;
            square_z[k] += dz * dz;
            known[k] += counts ? 1.0f : 0.0f;
            const float near_z = counts ? middle : least[k], far_z = counts ? middle : greatest[k];
            const float near_d = counts ? d_z : least_d[k], far_d = counts ? d_z : greatest_d[k];
            least[k] = near_z < least[k] ? near_z : least[k];
            greatest[k] = greatest[k] < far_z ? far_z : greatest[k];
            least_d[k] = near_d < least_d[k] ? near_d : least_d[k];
            greatest_d[k] = greatest_d[k] < far_d ? far_d : greatest_d[k];
        }
    }
    layer_motion<float> motion() const
    {
        layer_motion_sums<float> all = sums;
        for (std::size_t k = 0; k < count; ++k) {
            all.x += x[k];
            all.y += y[k];
            all.z += z[k];
            all.square += square[k];
            all.square_z += square_z[k];
            all.count += known[k];
            all.least = (std::min)(all.least, least[k]);
            all.greatest = (std::max)(all.greatest, greatest[k]);
            all.least_d = (std::min)(all.least_d, least_d[k]);
            all.greatest_d = (std::max)(all.greatest_d, greatest_d[k]);
        }
        return layer_motion_end(all);
    }
};

/// The motion of a layer of a tile, or of a part of one.
inline layer_motion<float> motion_of(window_samples& samples, const auto& layer)
{
    stochastic_sample<float> first{};
    bool found = false;
    samples.for_each_batch([&](const sample_batch& s) {
        for (std::size_t k = 0; k < s.count && !found; ++k)
            if (0 < layer.share(s, k).opacity) {
                found = true;
                first = s[k];
            }
    });
    motion_lanes lanes(first);
    samples.for_each_batch([&](const sample_batch& s) {
        for (std::size_t n = 0; n < s.rounded(); n += lanes.count) lanes.add(s, n, layer);
    });
    return lanes.motion();
}

/// The runs of empty bins of a window with these occupied bins, as of layer_cuts_add for all 64. Runs of less than `gap`
/// bins count as filled.
inline layer_runs<float> runs_of(const layer_window<float>& window, std::uint64_t occupied, std::size_t gap = 1)
{
    layer_runs<float> runs = layer_cuts_begin(window);
    while (occupied != 0) {
        const int empty = std::countr_zero(occupied), full = std::countr_one(occupied >> empty);
        runs.empty += std::size_t(empty) < gap ? 0 : float(empty) * runs.begun;
        runs.bins += float(empty);
        runs = layer_cuts_add(runs, 1.0f);
        runs.bins += float(full - 1);
        occupied = empty + full < 64 ? occupied >> empty >> full : 0;
    }
    return runs;
}

/// The division of a layer at the longest run of at least `bins` empty ones between its motions.
inline layer_division division_of(window_samples& samples, const whole_layer& layer, std::size_t bins)
{
    const layer_motion<float> motion = motion_of(samples, layer);
    layer_division division;
    if (!(motion.spread >= layer_least_spread)) return division;
    layer_direction_sums<float> sums = layer_direction_begin(motion);
    const auto for_each = [&](const auto& f) {
        samples.for_each_batch([&](const sample_batch& s) {
            for (std::size_t k = 0; k < s.count; ++k)
                if (0 < layer.share(s, k).opacity) f(s[k], s.middle[k]);
        });
    };
    for_each([&](const stochastic_sample<float>& s, float middle) { sums = layer_direction_add(sums, s, middle); });
    division.direction = layer_direction_end(sums);
    const auto key = [&](const stochastic_sample<float>& s) { return layer_direction_key(division.direction, s); };
    layer_window<float> window = layer_window_begin(float(layer_background_depth));
    for_each([&](const stochastic_sample<float>& s, float) { window = layer_window_add(window, key(s)); });
    std::uint64_t occupied = 0;
    for_each([&](const stochastic_sample<float>& s, float) {
        const float bin = layer_bin_of(key(s), window);
        if (0 <= bin) occupied |= std::uint64_t(1) << unsigned(bin);
    });
    division.cut = layer_part_cut(runs_of(window, occupied), float(bins));
    std::array<layer_window<float>, 2> depths;
    depths.fill(layer_window_begin(float(layer_background_depth)));
    for_each([&](const stochastic_sample<float>& s, float middle) {
        layer_window<float>& of = depths[key(s) < division.cut ? 0 : 1];
        of = layer_window_add(of, middle);
    });
    for (std::size_t k = 0; k < 2; ++k) division.centres[k] = 0.5f * (depths[k].least + depths[k].greatest);
    return division;
}

} // namespace detail

/// Call f(layer) for the layers of a tile, and for both parts of one that is divided.
inline void for_each_layer(const tile_clusters& tile, const auto& f)
{
    std::size_t left = tile.layers;
    for (std::size_t k = 0; left > 0; ++k) {
        const detail::whole_layer layer{tile.cuts, float(k)};
        if (tile.divisions[k].divides()) {
            for (const std::size_t part : {std::size_t(0), std::size_t(1)})
                f(detail::layer_part{layer, tile.divisions[k], float(part), tile.divisions[k].centres[part]});
            left -= 2;
        } else {
            f(layer);
            --left;
        }
    }
}

GNOMON_NAMESPACE_END
#endif
