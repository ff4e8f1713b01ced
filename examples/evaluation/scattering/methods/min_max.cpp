// Min-max mipmaps over the rows of a rectified map (Chen et al. 2011): exact for the map, and without any filter. From the row
// that holds the view ray, as in the paper, and interpolated between the two next to it, as prefiltered maps are.
#include "evaluation/scattering/rectified_scene.hpp"
#include "shadow_map_steps.hpp"

#include <gnomon/passes/min_max_rows.hpp>
#include <gnomon/passes/rectified_look_up.hpp>

#include <cmath>

namespace gnomon::evaluation {

namespace {

const registered<map_kind> min_max_kind{
    map_kind{.id = "min_max_rows", .label = "rows of a min-max mipmap", .order = 61}};
const registered<family> min_max{family{.id = "min_max", .label = "min-max mipmaps", .order = 17, .colour = "#8c564b"}};

// With as many columns as whole blocks need, and the cosine for a depth, which needs no angle.
scattering_scene in_whole_blocks(scattering_scene scene)
{
    scene.columns = (scene.columns + min_max_block - 1) / min_max_block * min_max_block;
    return scene;
}

class min_max_map final : public scattering_map {
  public:
    min_max_map(const scattering_scene& given, bool between_rows)
        : scene_(in_whole_blocks(given)),
          rectified_(scene_, {rectified_source::texel, rectified_depth::cosine, true}),
          is_between_rows_(between_rows),
          depths_(scene_.columns * scene_.rows),
          nodes_(min_max_nodes(scene_.columns) * scene_.rows)
    {
        const row_range all{0, scene_.rows};
        time("rectify", [&] {
            rectify_depths(scene_.depths.plain(), scene_.map, rectified_.frame, rectified_.rows,
                           {depths_, scene_.columns, scene_.rows}, all);
        });
        time("mips", [&] { build_min_max_rows(depths(), {nodes_, min_max_nodes(scene_.columns), scene_.rows}, all); });
    }

    std::size_t bytes() const override
    {
        return depths_.size() * sizeof(float) + nodes_.size() * sizeof(depth_interval);
    }

    std::vector<build_pass> passes() const override { return passes_; }

    void visibilities(std::span<const view_segment> where, std::span<float> result) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i) result[i] = visibility(where[i]);
    }

    // Ray by ray; texels of a row are compared by packs.
    std::vector<timed_look_up> timed(std::span<const view_segment> where) const override
    {
        const timed_run all{where.size(), [this, where](std::span<float> result) {
                                for (std::size_t i = 0; i < where.size(); ++i) {
                                    result[i] = visibility(where[i]);
                                    asm volatile("" ::: "memory"); // one ray at a time
                                }
                            }};
        return {{1, all, all}};
    }

  private:
    map_view<const float> depths() const { return {depths_, scene_.columns, scene_.rows}; }
    map_view<const depth_interval> nodes() const { return {nodes_, min_max_nodes(scene_.columns), scene_.rows}; }

    [[gnu::flatten]] float visibility(const view_segment& s) const
    {
        const float radius = std::sqrt(s.end.x * s.end.x + s.end.y * s.end.y);
        const float cosine = rectified_cosine(s.end.x, s.end.y, s.end.z);
        const rectified_frame& frame = rectified_.frame;
        const float row = rectified_row_of(polynomial_atan2(s.end.y, s.end.x), frame.azimuth_start,
                                           frame.azimuth_length, float(scene_.rows));
        const float step = rectified_radius_step(frame, scene_.columns), x = radius / step;
        const float sine = radius / std::sqrt(radius * radius + s.end.z * s.end.z);
        const float q = transmittance_step(scene_.extinction, step, sine);
        const auto in_row = [&](std::size_t v) {
            return min_max_intensity(depths(), nodes(), q, v, x,
                                     rectified_cosine_depth(cosine, rectified_.rows[v].range));
        };
        if (!is_between_rows_) return 1 - in_row(std::min(std::size_t(std::max(row, 0.f)), scene_.rows - 1));
        const gnomon::detail::neighbours n = gnomon::detail::rectified_rows_of(row, scene_.rows, frame.wraps());
        const float lower = in_row(n.lower);
        return 1 - (n.fraction > 0 ? lower + n.fraction * (in_row(n.upper) - lower) : lower);
    }

    void time(const char* name, auto&& pass) { passes_.push_back({name, 1e3 * seconds_on_one_core(pass)}); }

    scattering_scene scene_;
    rectified_scene rectified_;
    bool is_between_rows_;
    std::vector<float> depths_;
    std::vector<depth_interval> nodes_;
    std::vector<build_pass> passes_;
};

class min_max_method final : public scattering_method {
  public:
    min_max_method(const char* its_id, const char* its_label, double its_order, bool its_between_rows)
        : scattering_method({.id = its_id,
                             .family = "min_max",
                             .label = its_label,
                             .order = its_order,
                             .map = "min_max_rows",
                             .format = {"depth_float", "32 bit depth", sizeof(float)}}),
          between_rows(its_between_rows)
    {}

    std::unique_ptr<scattering_map> build(const scattering_scene& scene) const override
    {
        return std::make_unique<min_max_map>(scene, between_rows);
    }

    const bool between_rows;
};

const registered<min_max_method> of_row{"min_max", "min-max mipmap", 1.0, false};
const registered<min_max_method> of_rows{"min_max_rows", "min-max mipmap, two rows", 2.0, true};

} // namespace

} // namespace gnomon::evaluation
