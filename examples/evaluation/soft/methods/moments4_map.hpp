// Maps of four moments for look-ups that read more than one search region and one filter region. Such a look-up is a
// function of a receiver and of a reader:
//
//     struct shadow {
//         static constexpr bool reads_depths = false;     true for a pyramid of least and greatest depths beside the table
//         float operator()(const soft_light& light, const soft_receiver& where, auto& read) const;
//     };
//     read.search(rectangle)      mean channels over the texels that a rectangle touches
//     read.filter(rectangle)      mean channels over a rectangle
//     read.depths(rectangle)      least and greatest depth of these texels
//
// The kernels alone are timed with a reader that returns what was read before.
#pragma once

#include "moments4.hpp"

#include <gnomon/passes/depth_pyramid.hpp>
#include <gnomon/soft/depth_interval.h>

namespace gnomon::evaluation {

// What one look-up has read, in its order.
struct read_values {
    std::array<channels4<float>, 3> channels{};
    depth_interval depths{};
};

template <class Shadow> class moments4_map final : public soft_shadow_map {
  public:
    moments4_map(const soft_depths& depths, const soft_light& light)
        : light_(light),
          most_texels_(static_cast<std::size_t>(light.most_texels())),
          width_(static_cast<std::size_t>(depths.samples.width)),
          height_(static_cast<std::size_t>(depths.samples.height)),
          texels_(width_ * height_),
          blocks_(Shadow::reads_depths ? depth_pyramid_blocks(width_, height_) : 0)
    {
        using samples = std::array<float, 4>;
        const map_view<const samples> source{depths.samples.pixels, width_, height_};
        build_summed_area<moments4_summed>(source, map_view<moments4_summed::texel>{texels_, width_, height_},
                                           most_texels_);
        if (Shadow::reads_depths)
            build_depth_pyramid(source, depth_pyramid_view<depth_interval>{blocks_, width_, height_});
    }

    std::size_t bytes() const override
    {
        return texels_.size() * sizeof texels_[0] + blocks_.size() * sizeof(depth_interval);
    }

    void intensities(std::span<const soft_receiver> where, std::span<float> result) const override
    {
        const reader read{this};
        for (std::size_t i = 0; i < where.size(); ++i) result[i] = Shadow{}(light_, where[i], read);
    }

    std::vector<timed_look_up> timed(std::span<const soft_receiver> where) const override
    {
        std::vector<read_values> values(where.size());
        tbb::parallel_for(std::size_t(0), where.size(), [&](std::size_t i) {
            const recorder read{{this}, &values[i]};
            Shadow{}(light_, where[i], read);
        });
        const auto kernels = [this, where, values = std::move(values)](std::span<float> result) {
            for (std::size_t i = 0; i < where.size(); ++i) {
                const replayer read{&values[i]};
                result[i] = Shadow{}(light_, where[i], read);
            }
        };
        const auto all = [this, where](std::span<float> result) { intensities(where, result); };
        return {{1, {where.size(), kernels}, {where.size(), all}}};
    }

    std::optional<skipped_shares> skipped(std::span<const soft_receiver> where) const override
    {
        if constexpr (Shadow::reads_depths) {
            const reader read{this};
            skipped_shares shares;
            for (const soft_receiver& r : where) {
                const decided_shadow<float> found = Shadow::decided(light_, r, read);
                if (found.decided > 0) (found.intensity > 0 ? shares.umbra : shares.lit) += 1;
            }
            const double all = double(std::max<std::size_t>(where.size(), 1));
            return skipped_shares{shares.umbra / all, shares.lit / all};
        } else {
            return {};
        }
    }

  private:
    using rectangle = summed_area_rectangle<float>;

    struct reader {
        const moments4_map* map;

        channels4<float> search(const rectangle& r) const
        {
            return grid_average<moments4_summed>(map->table(), map->most_texels_, r);
        }
        channels4<float> filter(const rectangle& r) const
        {
            return rectangle_average<moments4_summed>(map->table(), map->most_texels_, r);
        }
        depth_interval depths(const rectangle& r) const
        {
            const rectangle texels = summed_area_grow(map->light_.clipped(r));
            return depth_interval_in(map->pyramid(), texels.x0, texels.y0, texels.x1, texels.y1);
        }
    };

    struct recorder {
        reader live;
        read_values* values;
        mutable std::size_t count = 0;

        channels4<float> search(const rectangle& r) const { return values->channels[count++] = live.search(r); }
        channels4<float> filter(const rectangle& r) const { return values->channels[count++] = live.filter(r); }
        depth_interval depths(const rectangle& r) const { return values->depths = live.depths(r); }
    };

    struct replayer {
        const read_values* values;
        mutable std::size_t count = 0;

        channels4<float> search(const rectangle&) const { return values->channels[count++]; }
        channels4<float> filter(const rectangle&) const { return values->channels[count++]; }
        depth_interval depths(const rectangle&) const { return values->depths; }
    };

    map_view<const moments4_summed::texel> table() const { return {texels_, width_, height_}; }
    depth_pyramid_view<const depth_interval> pyramid() const { return {blocks_, width_, height_}; }

    soft_light light_;
    std::size_t most_texels_, width_, height_;
    std::vector<moments4_summed::texel> texels_;
    std::vector<depth_interval> blocks_;
};

template <class Shadow> class moments4_method final : public soft_method {
  public:
    explicit moments4_method(method_facts facts) : soft_method(completed(std::move(facts))) {}

    std::unique_ptr<soft_shadow_map> build(const soft_depths& depths, const soft_light& light) const override
    {
        return std::make_unique<moments4_map<Shadow>>(depths, light);
    }

  private:
    static method_facts completed(method_facts facts)
    {
        using table = moments4_summed;
        facts.map = summed_kind->id;
        facts.format = {std::string(table::id), std::string(table::name), double(table::bytes_per_texel)};
        return facts;
    }
};

// Shadow intensity after a search that found h, by the mean blocker: what msm4_soft does.
inline float one_occluder(const hankel4<float>& h, const soft_light& light, const soft_receiver& where, auto& read)
{
    const soft_widths<float> widths = light.penumbra(where.depth, moments4_kernels::blocker(h, where.depth));
    const channels4<float> within = read.filter(soft_light::filter_rectangle(where, widths));
    return over_darken(moments4_kernels::shadow(within, light.most_texels(), biased_depth(where, widths)),
                       1 - umbra_epsilon);
}

} // namespace gnomon::evaluation
