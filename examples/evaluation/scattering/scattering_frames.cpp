#include "scattering_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float change_scale = 0.125f; // of visibility, at which colours of changes saturate

// Visibilities at points that are seen in a frame, from that frame's camera and from the next one's.
struct frame_pair {
    std::vector<float> before, after;
};

std::vector<float> changes(const frame_pair& pair)
{
    std::vector<float> result(pair.before.size());
    std::ranges::transform(pair.after, pair.before, result.begin(), std::minus());
    return result;
}

// The same points in the light axes of another camera.
std::vector<view_segment> moved(std::span<const view_segment> where, const glm::vec3& by)
{
    std::vector<view_segment> result(where.begin(), where.end());
    for (view_segment& s : result) s.end -= by;
    return result;
}

// Pairs of successive frames of a scene, by the reference and by methods.
class frame_comparison {
  public:
    frame_comparison(const compared_scattering_scene& scene, const std::filesystem::path& folder, steps& all,
                     std::size_t count, const std::function<scattering_stage(std::size_t)>& stage)
        : scene_(scene), folder_(folder), all_(all)
    {
        begin(scattering_references[1].label);
        for (std::size_t i = 0; i < count; ++i) stages_.push_back(stage(i));
        for (const scattering_stage& s : stages_) views_.push_back(std::make_unique<scattering_view>(s, scene.how));
        for (std::size_t i = 0; i + 1 < count; ++i) {
            const camera &eye = stages_[i].eye, &next = stages_[i + 1].eye;
            const bool moves = eye.position != next.position;
            const glm::dvec3 way = in_light_axes(stages_[i].light, next.position - eye.position);
            later_.push_back(moves ? moved(views_[i]->where, glm::vec3(way)) : views_[i + 1]->where);
            traced_.push_back({views_[i]->traced(views_[i]->where), views_[i + 1]->traced(later_[i])});
        }
    }

    const std::vector<frame_pair>& traced() const { return traced_; }

    std::vector<frame_pair> of(const scattering_method& m) const
    {
        begin(m.label);
        std::vector<frame_pair> result(later_.size());
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const std::unique_ptr<scattering_map> map = m.build(views_[i]->scene());
            if (i < result.size()) result[i].before = visibilities_of(*map, views_[i]->where);
            if (i > 0) result[i - 1].after = visibilities_of(*map, later_[i - 1]);
        }
        return result;
    }

    // The compared scene's row of the method with errors of changes, or of their sizes.
    report_row row(const scattering_method& m, const std::vector<frame_pair>& frames, bool sizes) const
    {
        const auto all_changes = [&](const std::vector<frame_pair>& pairs) {
            std::vector<float> all;
            for (const frame_pair& pair : pairs)
                for (const float x : changes(pair)) all.push_back(sizes ? std::abs(x) : x);
            return all;
        };
        const std::vector<float> estimate = all_changes(frames), expected = all_changes(traced_);
        report_row result = scene_.method(m.id).traced();
        result.part = "change";
        result.receivers = static_cast<long long>(estimate.size());
        result.errors = compare(estimate, expected);
        return result;
    }

    // The changes of the first pair, or what of them is beyond those of the reference.
    std::string draw(const std::string& id, const std::vector<frame_pair>& frames, bool beyond) const
    {
        image<float> change = pixels(changes(frames[0])), expected(change.width, change.height);
        if (beyond) expected = pixels(changes(traced_[0]));
        std::string file = fmt::format("{}-{}-difference.png", scene_.scene.id, id);
        write_png(folder_ / file, reduced(error_picture(change, expected, change_scale), scene_.how.supersampling));
        return file;
    }

  private:
    void begin(std::string_view what) const { all_.begin(fmt::format("{}, frames: {}", scene_.scene.label, what)); }

    image<float> pixels(const std::vector<float>& values) const
    {
        image<float> result(views_[0]->seen.width, views_[0]->seen.height);
        std::ranges::copy(values, result.pixels.begin());
        return result;
    }

    const compared_scattering_scene& scene_;
    std::filesystem::path folder_;
    steps& all_;
    std::vector<scattering_stage> stages_;
    std::vector<std::unique_ptr<scattering_view>> views_;
    std::vector<std::vector<view_segment>> later_; // the points of each frame, from the next one's camera
    std::vector<frame_pair> traced_;
};

// With and without filtering, and rivals.
constexpr std::array at_the_gate{"ray_march_32",
                                 "min_max_rows",
                                 "froxels",
                                 "scatter_csm_paper",
                                 "scatter_csm",
                                 "scatter4_unorm16_paper",
                                 "scatter4_unorm16_paper_filtered",
                                 "scatter4_unorm16_texel",
                                 "scatter4_unorm16",
                                 "scatter4_unorm16_moments",
                                 "scatter6_unorm10_paper",
                                 "scatter6_unorm10_paper_filtered",
                                 "scatter6_unorm16_paper",
                                 "scatter6_unorm16_paper_filtered",
                                 "scatter6_unorm16_texel",
                                 "scatter6_unorm16",
                                 "scatter6_unorm16_moments"};
constexpr std::array of_the_dragon{
    "min_max_rows",           "froxels",          "scatter_csm_paper",      "scatter_csm",
    "scatter4_unorm16_paper", "scatter4_unorm16", "scatter6_unorm10_paper", "scatter6_unorm10_paper_filtered",
    "scatter6_unorm16_paper", "scatter6_unorm16"};

// The results of a function of a method, for each id, by two threads.
auto for_methods(std::span<const char* const> ids, const auto& result_of)
{
    const auto of_id = [&](const char* id) {
        return result_of(dynamic_cast<const scattering_method&>(registry_of<method>().at(id)));
    };
    std::vector<decltype(of_id(""))> results(ids.size());
    const auto each_second = [&](std::size_t first) {
        for (std::size_t i = first; i < ids.size(); i += 2) results[i] = of_id(ids[i]);
    };
    std::future<void> others = std::async(std::launch::async, each_second, 1);
    each_second(0);
    others.get();
    return results;
}

struct drawn_frames {
    const scattering_method* of = nullptr;
    report_row row;
    std::string file;
};

std::vector<std::pair<std::string, std::string>> key_of_changes()
{
    return {{"#2a62cc", fmt::format("brighter; full colour at {:g}", double(change_scale))}, {"#c8232c", "darker"}};
}

} // namespace

std::size_t steps_of_gate_frames() { return 1 + at_the_gate.size(); }
std::size_t steps_of_entering_frames() { return 1 + of_the_dragon.size(); }

page_part compare_gate_frames(const compared_scattering_scene& gate, const std::filesystem::path& folder, steps& all)
{
    const frame_comparison frames(gate, folder, all, gate_frames, [&](std::size_t i) {
        return gate_stage(double(gate.how.width) / gate.how.height, float(i) * gate_frame_time);
    });
    page_part result;
    table_block table{
        .title = "Stability as the camera moves",
        .text = fmt::format(
            "{} frames of a camera that moves sideways by {:.0f} mm from one to the next. Points that are seen in "
            "a frame are looked up from the next camera, too. <i>Beyond</i> is the mean change of their "
            "visibility beyond that of the reference, in thousandths: flicker that is no motion of "
            "the light. <i>Missing</i> is the mean change of the reference beyond that of the method.",
            gate_frames, 300 * double(gate_frame_time)),
        .columns = {{.key = "method", .label = "method"},
                    {.key = "beyond", .label = "beyond", .digits = 2, .scale = 1e3, .best = best::low},
                    {.key = "missing", .label = "missing", .digits = 2, .scale = 1e3, .best = best::low},
                    {.key = "rms", .label = "root mean square", .digits = 2, .scale = 1e3, .best = best::low}},
        .rows = {}};
    pictures_block pictures{.title = {},
                            .text = "Changes from the first frame to the second beyond those of the reference.",
                            .columns = 3,
                            .pictures = {}};
    for (const drawn_frames& found : for_methods(at_the_gate, [&](const scattering_method& m) {
             const std::vector<frame_pair> pairs = frames.of(m);
             return drawn_frames{&m, frames.row(m, pairs, true), frames.draw(m.id, pairs, true)};
         })) {
        const error_statistics& e = found.row.errors;
        const std::string& label = found.of->label;
        table.rows.push_back({{{"method", label}, {"beyond", e.leak}, {"missing", e.acne}, {"rms", e.rmse}},
                              found.of->its_family().colour});
        pictures.pictures.push_back(
            {found.file,
             fmt::format("Change of the picture by {} beyond that of the reference: {:.2g} on average", label, e.leak),
             escaped(label)});
        result.rows.push_back(found.row);
    }
    pictures.key = key_of_changes();
    result.blocks = {std::move(table), std::move(pictures)};
    return result;
}

page_part compare_entering_frames(const compared_scattering_scene& entering, const std::filesystem::path& folder,
                                  steps& all)
{
    const frame_comparison frames(entering, folder, all, 2, [&](std::size_t i) {
        return entering_stage(double(entering.how.width) / entering.how.height, i == 1);
    });
    page_part result;
    pictures_block pictures{
        .title = "Changes as the dragon enters",
        .text =
            "The change of visibility from the scene without the dragon to the scene with it. Blue is "
            "brighter, red darker. Light above the dragon should not change.",
        .columns = 3,
        .pictures = {},
        .is_folded = false};
    pictures.pictures.push_back({frames.draw("traced", frames.traced(), false),
                                 "Change by ray tracing: darker on and below the dragon only",
                                 "reference: ray tracing"});
    for (const drawn_frames& found : for_methods(of_the_dragon, [&](const scattering_method& m) {
             const std::vector<frame_pair> pairs = frames.of(m);
             return drawn_frames{&m, frames.row(m, pairs, false), frames.draw(m.id, pairs, false)};
         })) {
        const double off = found.row.errors.mean_abs;
        const std::string& label = found.of->label;
        pictures.pictures.push_back(
            {found.file, fmt::format("Change by {}: {:.2g} off the change of the reference on average", label, off),
             fmt::format("{}: off by {:.2g} thousandths on average", escaped(label), 1e3 * off)});
        result.rows.push_back(found.row);
    }
    pictures.key = key_of_changes();
    result.blocks = {std::move(pictures)};
    return result;
}

} // namespace gnomon::evaluation
