#include "comparison.hpp"

#include "evaluation/core/method.hpp"
#include "evaluation/core/percentage_closer.hpp"
#include "evaluation/core/receivers.hpp"
#include "evaluation/core/report.hpp"
#include "evaluation/core/timing.hpp"
#include "renderer/output/file.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/trace/tracer.hpp"

#include <gnomon/passes/blur.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const auto taps = gaussian_weights();

constexpr float error_scale = 0.5f; // visibility at which error colours saturate

// Nanoseconds per receiver: the least time of at least three runs, and of as many as fit into 0.15 s.
double nanoseconds(const timed_run& timed, std::span<float> result)
{
    double least = std::numeric_limits<double>::infinity(), spent = 0;
    for (int i = 0; i < 3 || spent < 0.15; ++i) {
        const double time = seconds([&] { timed.run(result); });
        least = std::min(least, time);
        spent += time;
    }
    return 1e9 * least / double(std::max<std::size_t>(timed.receivers, 1));
}

struct timing {
    int lanes;
    double ns_kernel, ns_look_up;
};

struct outcome {
    const method& of;
    double build_ms, map_bytes;
    std::vector<float> visibility, unbiased; // per receiver, and without depth bias
    std::vector<timing> timings;
};

outcome outcome_of(const shadow_method& m, const depth_map& depths, const map_receivers& where)
{
    outcome result{m, 0, 0, {}, {}, {}};
    std::unique_ptr<shadow_map> map;
    result.build_ms = 1e3 * seconds([&] { map = m.build(depths, taps); });
    result.map_bytes = double(map->bytes());
    std::vector<float> intensities(where.size());
    for (const timed_look_up& t : map->timed(where.biased))
        result.timings.push_back({t.lanes, nanoseconds(t.kernel, intensities), nanoseconds(t.look_up, intensities)});
    const auto visibility = [&](std::span<const map_receiver> some) {
        map->intensities(some, intensities);
        std::vector<float> visible(intensities.size());
        std::ranges::transform(intensities, visible.begin(), [](float intensity) { return 1 - intensity; });
        return visible;
    };
    result.visibility = visibility(where.biased);
    result.unbiased = visibility(where.unbiased);
    return result;
}

class comparison {
  public:
    comparison(std::string name, const stage& scenery, const settings& how)
        : name_(std::move(name)), stage_(scenery), how_(how), folder_(how.out / "gallery" / name_)
    {
        progress(name_, "shadow map, camera image, ray tracing");
        const int columns = how.width * how.supersampling, rows = how.height * how.supersampling;
        tracer rays(stage_.world);
        depths_ = rasterize_depth<4>(stage_.world, stage_.light, how.map_resolution, how.map_resolution);
        seen_ = rasterize_surfaces(stage_.world, stage_.eye, columns, rows);
        where_ = map_receivers_of(seen_, stage_.light, how.map_resolution);
        const image<float> traced = traced_visibility(rays, stage_.light, seen_);
        for (const std::size_t pixel : where_.pixels) traced_.push_back(traced.pixels[pixel]);
        traced_image_ = image_of(traced_);

        progress(name_, "reference: percentage-closer filtering with the same weights");
        filtered_ = filtered_visibility(where_.biased);
        filtered_unbiased_ = filtered_visibility(where_.unbiased);
        filtered_image_ = image_of(filtered_);

        const int gap = 4, magnification = 4;
        const int size = (how.width - 2 * gap) / (3 * magnification);
        for (const point_of_interest& place : stage_.interests)
            insets_.push_back(inset_around(place, stage_.eye, size, how.width, how.height));
        facts_ = {{"scene", stage_.world.name},
                  {"width", how.width},
                  {"height", how.height},
                  {"supersampling", how.supersampling},
                  {"map_resolution", how.map_resolution},
                  {"taps", taps.size()},
                  {"bias_radius", bias_radius},
                  {"error_scale", error_scale},
                  {"too_dark", too_dark},
                  {"receivers", where_.size()},
                  {"methods", nlohmann::json::array()},
                  {"insets", nlohmann::json::array()}};
        for (const point_of_interest& place : stage_.interests) {
            const glm::vec3& c = place.colour;
            facts_["insets"].push_back(
                {{"name", place.name},
                 {"colour", fmt::format("#{:02x}{:02x}{:02x}", srgb8(c.r), srgb8(c.g), srgb8(c.b))}});
        }
        write_png(folder_ / "traced.png", figure(shaded(traced_image_)));
        write_png(folder_ / "filtered.png", figure(shaded(filtered_image_)));
    }

    void add(const outcome& o)
    {
        const std::string file = fmt::format("method{:02}", facts_["methods"].size());
        const image<float> estimate = image_of(o.visibility);
        tbb::parallel_invoke(
            [&] { write_png(folder_ / (file + ".png"), figure(shaded(estimate))); },
            [&] { write_png(folder_ / (file + "-filtered.png"), figure(error(estimate, filtered_image_))); },
            [&] { write_png(folder_ / (file + "-traced.png"), figure(error(estimate, traced_image_))); });
        facts_["methods"].push_back({{"method", o.of.label}, {"format", o.of.format.label}, {"file", file}});
        add_rows(o);
    }

    void finish() const
    {
        write_file(folder_ / "facts.json", facts_.dump(1));
        merge_report(how_.out / "report.json", rows_);
    }

    const depth_map& depths() const { return depths_; }
    const map_receivers& where() const { return where_; }

  private:
    std::vector<float> filtered_visibility(const std::vector<map_receiver>& some) const
    {
        std::vector<float> result(where_.size());
        tbb::parallel_for(std::size_t(0), where_.size(), [&](std::size_t i) {
            result[i] = 1 - static_cast<float>(percentage_closer_intensity<double>(depths_, some[i], taps));
        });
        return result;
    }

    image<float> image_of(std::span<const float> visibility) const
    {
        image<float> result(seen_.width, seen_.height, 1);
        for (std::size_t i = 0; i < where_.size(); ++i) result.pixels[where_.pixels[i]] = visibility[i];
        return result;
    }

    picture shaded(const image<float>& visibility) const
    {
        return reduced(shade(stage_.world, stage_.light, seen_, visibility), how_.supersampling);
    }

    picture error(const image<float>& estimate, const image<float>& reference) const
    {
        return error_picture(reduced(estimate, how_.supersampling), reduced(reference, how_.supersampling),
                             error_scale);
    }

    // The picture with its insets framed, above the insets magnified.
    picture figure(const picture& whole) const
    {
        if (insets_.empty()) return whole;
        picture framed = whole;
        std::vector<picture> magnified;
        for (std::size_t i = 0; i < insets_.size(); ++i) {
            const glm::vec3& colour = stage_.interests[i].colour;
            outline(framed, insets_[i], colour);
            picture inset = magnify(whole, insets_[i], 4);
            outline(inset, {4, 4, inset.width - 8, inset.height - 8}, colour, 4);
            magnified.push_back(std::move(inset));
        }
        return stacked(std::array{framed, side_by_side(magnified)});
    }

    void add_rows(const outcome& o)
    {
        add_rows(o, stage_.world.name, {0, 0, how_.width, how_.height});
        for (std::size_t i = 0; i < insets_.size(); ++i)
            add_rows(o, stage_.world.name + ": " + stage_.interests[i].name, insets_[i]);
    }

    void add_rows(const outcome& o, const std::string& scene, const rectangle& part)
    {
        std::vector<float> estimate, filtered, traced, unbiased, filtered_unbiased;
        for (std::size_t i = 0; i < where_.size(); ++i) {
            const int pixel = static_cast<int>(where_.pixels[i]);
            const int x = pixel % seen_.width / how_.supersampling, y = pixel / seen_.width / how_.supersampling;
            if (x < part.x || x >= part.x + part.width || y < part.y || y >= part.y + part.height) continue;
            estimate.push_back(o.visibility[i]);
            filtered.push_back(filtered_[i]);
            traced.push_back(traced_[i]);
            unbiased.push_back(o.unbiased[i]);
            filtered_unbiased.push_back(filtered_unbiased_[i]);
        }
        report_row row = row_of(o.of);
        row.scene = scene;
        row.method = o.of.label; // as the gallery reads rows
        row.receivers = static_cast<long long>(estimate.size());
        row.map_bytes = o.map_bytes;
        row.build_ms = o.build_ms;
        for (const timing& t : o.timings) {
            row.lanes = t.lanes;
            row.ns_kernel = t.ns_kernel;
            row.ns_per_receiver = t.ns_look_up;
            row.reference = "filtered";
            row.errors = compare(estimate, filtered);
            row.acne_unbiased = compare(unbiased, filtered_unbiased).acne;
            rows_.push_back(row);
            row.reference = "traced";
            row.errors = compare(estimate, traced);
            row.acne_unbiased.reset();
            rows_.push_back(row);
        }
    }

    std::string name_;
    const stage& stage_;
    settings how_;
    std::filesystem::path folder_;
    depth_map depths_;
    image<surface> seen_;
    map_receivers where_;
    std::vector<float> filtered_, filtered_unbiased_, traced_; // visibility per receiver
    image<float> filtered_image_, traced_image_;
    std::vector<rectangle> insets_;
    nlohmann::ordered_json facts_;
    std::vector<report_row> rows_;
};

} // namespace

void compare_methods(const std::string& name, const stage& scenery, const settings& how)
{
    comparison c(name, scenery, how);
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const shadow_method*>(m)) {
            progress(name, one->label);
            c.add(outcome_of(*one, c.depths(), c.where()));
        }
    c.finish();
}

} // namespace gnomon::evaluation
