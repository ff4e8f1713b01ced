#include "slices_study.hpp"

#include "evaluation/motion/receivers/stochastic.hpp"
#include "map_source.hpp"
#include "renderer/trace/tracer.hpp"
#include "slices.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr std::array slice_counts{4, 8, 16, 20, 32};
constexpr std::array slice_constants{0.f, .0025f, .005f, .01f, .02f, .04f, .08f, .16f, .32f};
constexpr std::size_t sweep_stride = 2; // every second column and row of pixels is looked up for a sweep
constexpr int study_times = 256;

class sliced_study {
  public:
    sliced_study(sliced_case what, const moving_stage& stage, const motion_settings& how)
        : stage_(stage),
          size_(how.size),
          folder_(how.folder),
          reference_(tracer(stage.world)
                         .photograph(stage.light, stage.eye, size_.width, size_.height,
                                     std::min(study_times, size_.reference_samples))),
          maps_(stage.world, stage.light, size_.map_resolution),
          ranges_(maps_.map("covered_prism_ranges")),
          found_{.what = std::move(what)}
    {
        for (std::size_t i = 0; i < reference_.coverage.pixels.size(); ++i)
            if (reference_.coverage.pixels[i] >= 1) pixels_.push_back(i);
        found_.triangles = triangle_numbers(stage.world.open).count();
        found_.ranges_bytes = ranges_->bytes, found_.building_bytes = ranges_->building_bytes;
        found_.ranges_build_ms = ranges_->build_ms;
        found_.resolution = size_.map_resolution;
        found_.receivers = static_cast<long long>(pixels_.size());
        picture("reference", fmt::format("Ray tracing at {} times.", grouped(study_times)), reference_.colour);
    }

    sliced_results run()
    {
        for (const int samples : slice_counts) measure(samples);
        return std::move(found_);
    }

  private:
    void picture(std::string_view what, const std::string& caption, const renderer::picture& shown)
    {
        const std::string name = fmt::format("slices-{}-{}.png", found_.what.id, what);
        write_png(folder_ / name, shown);
        found_.pictures.push_back({name, found_.what.label + ": " + caption, caption});
    }

    bool is_swept(std::size_t pixel, std::size_t stride) const
    {
        const auto width = std::size_t(size_.width);
        return pixel % width % stride == 0 && pixel / width % stride == 0;
    }

    // Of every stride-th column and row.
    error_statistics errors_of(const seen_motion& seen, std::span<const float> visibility, std::size_t stride) const
    {
        const image<float> estimate = mean_visibility(seen, visibility);
        std::vector<float> found, expected;
        for (const std::size_t i : pixels_) {
            if (!is_swept(i, stride)) continue;
            found.push_back(estimate.pixels[i]), expected.push_back(reference_.visibility.pixels[i]);
        }
        return compare(found, expected);
    }

    template <class Texel>
    bias_result look_up(const sample_picture& samples, const seen_motion& seen, const slice_receivers& receivers,
                        const bias_kind& kind, bool pictured)
    {
        const time_slices_map<Texel> map(samples);
        std::vector<float> visibility(seen.segments.size());
        const double spent = seconds_on_one_core([&] { slice_visibility(map, receivers, 0, visibility); });
        bias_result result{errors_of(seen, visibility, 1), 1e3 * spent, map.bytes(), {}};
        if (pictured)
            picture(fmt::format("bias_{}", std::size_t(&kind - slice_biases.data())),
                    fmt::format("Time-dependent, {} samples, bias for {}: RMSE {:.1f} thousandths.", samples.samples,
                                kind.label, 1e3 * result.errors.rmse),
                    shade(stage_.world, stage_.light, seen, visibility));
        slice_receivers some;
        std::size_t pixel = 0;
        for (std::size_t i = 0; i < receivers.where.size(); ++i) {
            while (seen.first[pixel + 1] <= receivers.segments[i]) ++pixel;
            if (is_swept(pixel, sweep_stride))
                some.where.push_back(receivers.where[i]), some.segments.push_back(receivers.segments[i]);
        }
        for (const float constant : slice_constants) {
            slice_visibility(map, some, constant, visibility);
            const error_statistics e = errors_of(seen, visibility, sweep_stride);
            result.sweep.push_back({double(constant), e.leak, e.acne, e.rmse});
        }
        return result;
    }

    void measure(int samples)
    {
        sample_picture of_light;
        seen_motion seen;
        const bool pictured = samples == found_.what.pictured;
        count_result r{.samples = samples, .shadow_ms = 0, .camera_ms = 0};
        r.shadow_ms = 1e3 * seconds_on_one_core([&] {
                          of_light = rasterize_samples(stage_.world, stage_.light, size_.map_resolution,
                                                       size_.map_resolution, {.samples = samples, .seed = 1});
                      });
        r.camera_ms = 1e3 * seconds_on_one_core([&] {
                          seen = stochastic_visibility(stage_.world, stage_.eye, size_.width, size_.height, samples);
                      });
        const slice_receivers receivers = slice_receivers_of(seen, stage_.light, size_.map_resolution);
        r.by_bias = {look_up<slice_depth<float>>(of_light, seen, receivers, slice_biases[0], pictured),
                     look_up<slice_motion<float>>(of_light, seen, receivers, slice_biases[1], false),
                     look_up<time_dependent_sample<float>>(of_light, seen, receivers, slice_biases[2], pictured)};
        const std::vector<light_receiver> paths = light_receivers_of(seen, stage_.light, size_.map_resolution);
        std::vector<float> visibility(paths.size());
        r.ranges_ms = 1e3 * seconds_on_one_core([&] {
                          for (std::size_t i = 0; i < paths.size(); ++i)
                              visibility[i] = visibility_at(ranges_->map(), paths[i], paths[i].path.depth.t0);
                      });
        r.ranges = errors_of(seen, visibility, 1);
        if (pictured)
            picture("ranges",
                    fmt::format("Ranges of Hong &amp; Oh, {} samples: RMSE {:.1f} thousandths.", samples,
                                1e3 * r.ranges.rmse),
                    shade(stage_.world, stage_.light, seen, visibility));
        found_.by_count.push_back(std::move(r));
    }

    const moving_stage& stage_;
    motion_sizes size_;
    std::filesystem::path folder_;
    reference_picture reference_;
    map_source maps_;
    std::shared_ptr<const range_shadow_map> ranges_;
    std::vector<std::size_t> pixels_; // that see a surface all of the time
    sliced_results found_;
};

} // namespace

sliced_results study_slices(const sliced_case& what, const moving_stage& stage, const motion_settings& how)
{
    return sliced_study(what, stage, how).run();
}

} // namespace gnomon::evaluation
