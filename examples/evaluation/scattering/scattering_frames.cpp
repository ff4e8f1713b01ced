#include "scattering_frames.hpp"

#include "scattering_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float change_scale = 0.125f; // of visibility, at which colours of changes saturate

// Frames of a scene, by the reference and by methods.
class frame_comparison {
  public:
    frame_comparison(std::string scene, const settings& how, const std::filesystem::path& folder, steps& all,
                     std::size_t count, const std::function<scattering_stage(std::size_t)>& stage)
        : scene_(std::move(scene)), how_(how), folder_(folder), all_(all)
    {
        begin("reference");
        for (std::size_t i = 0; i < count; ++i) stages_.push_back(stage(i));
        for (const scattering_stage& s : stages_) {
            views_.push_back(std::make_unique<scattering_view>(s, how));
            traced_.push_back(views_.back()->traced());
        }
    }

    std::size_t size() const { return views_.size(); }
    const scattering_view& view(std::size_t frame) const { return *views_[frame]; }
    const std::vector<float>& traced(std::size_t frame) const { return traced_[frame]; }
    std::vector<std::vector<float>> frames_of(const scattering_method& m) const
    {
        begin(m.label);
        std::vector<std::vector<float>> result;
        for (const auto& v : views_) result.push_back(visibilities_of(*m.build(v->scene()), v->where));
        return result;
    }

    // Changes from each frame to the next, one pair of frames after the other.
    static std::vector<float> changes(const std::vector<std::vector<float>>& frames)
    {
        std::vector<float> result;
        for (std::size_t k = 1; k < frames.size(); ++k)
            std::ranges::transform(frames[k], frames[k - 1], std::back_inserter(result), std::minus());
        return result;
    }

    report_row row(const scattering_method& m, const std::vector<std::vector<float>>& frames) const
    {
        const std::vector<float> estimate = changes(frames), expected = changes(traced_);
        report_row result = row_of(m);
        result.scene = scene_;
        result.part = "change";
        result.receiver = "view_rays";
        result.reference = scattering_references[1].id;
        result.receivers = static_cast<long long>(estimate.size());
        result.errors = compare(estimate, expected);
        return result;
    }

    std::string draw(const std::string& name, const picture& colours) const
    {
        const std::string file = fmt::format("{}-{}.png", scene_, name);
        write_png(folder_ / file, reduced(colours, how_.supersampling));
        return file;
    }

    // The change from the first frame to the last; white where nothing changes.
    picture change_of(const std::vector<std::vector<float>>& frames) const
    {
        return error_picture(pixels(frames.back()), pixels(frames.front()), change_scale);
    }
    picture beyond_reference(const std::vector<std::vector<float>>& frames) const
    {
        image<float> own = pixels(frames[1]), expected = pixels(traced_[1]);
        for (std::size_t i = 0; i < own.pixels.size(); ++i) {
            own.pixels[i] -= frames[0][i];
            expected.pixels[i] -= traced_[0][i];
        }
        return error_picture(own, expected, change_scale);
    }
    const std::vector<std::vector<float>>& traced() const { return traced_; }

  private:
    void begin(std::string_view what) const { all_.begin(fmt::format("{}, frames: {}", scene_, what)); }

    image<float> pixels(const std::vector<float>& visibility) const
    {
        image<float> result(views_[0]->seen.width, views_[0]->seen.height);
        std::ranges::copy(visibility, result.pixels.begin());
        return result;
    }

    std::string scene_;
    settings how_;
    std::filesystem::path folder_;
    steps& all_;
    std::vector<scattering_stage> stages_;
    std::vector<std::unique_ptr<scattering_view>> views_;
    std::vector<std::vector<float>> traced_;
};

std::vector<std::pair<std::string, std::string>> key_of_changes()
{
    return {{"#2a62cc", fmt::format("brighter; full colour at {:g}", double(change_scale))}, {"#c8232c", "darker"}};
}

} // namespace

std::size_t steps_of_gate_frames() { return 1 + scattering_methods("gate").size(); }
std::size_t steps_of_entering_frames() { return 1 + scattering_methods("entering").size(); }

compared_frames compare_gate_frames(const settings& how, const std::filesystem::path& folder, steps& all)
{
    const frame_comparison frames("gate", how, folder, all, gate_frames, [&](std::size_t i) {
        return gate_stage(double(how.width) / how.height, float(i) * gate_frame_time);
    });
    compared_frames result;
    table_block table{
        .title = "Stability as the camera moves",
        .text = fmt::format("{} frames of a camera that moves sideways. <i>Change</i> is the mean absolute change of "
                            "visibility of a pixel from one frame to the next beyond that of the reference, in "
                            "thousandths: flicker that is no motion of the light.",
                            gate_frames),
        .columns = {{.key = "method", .label = "method"},
                    {.key = "change", .label = "change", .digits = 2, .scale = 1e3, .best = best::low},
                    {.key = "rms", .label = "root mean square", .digits = 2, .scale = 1e3, .best = best::low},
                    {.key = "most", .label = "largest", .digits = 0, .scale = 1e3, .best = best::low}},
        .rows = {}};
    pictures_block pictures{.title = {},
                            .text = "Changes from the first frame to the second beyond those of the reference.",
                            .columns = 3,
                            .pictures = {},
                            .is_folded = false};
    for (const scattering_method* m : scattering_methods("gate")) {
        const std::vector<std::vector<float>> found = frames.frames_of(*m);
        const report_row row = frames.row(*m, found);
        const error_statistics& e = row.errors;
        table.rows.push_back({{{"method", m->label}, {"change", e.mean_abs}, {"rms", e.rmse}, {"most", e.max_abs}},
                              m->its_family().colour});
        pictures.pictures.push_back(
            {frames.draw(m->id + "-difference", frames.beyond_reference(found)),
             fmt::format("Change of the picture by {} beyond that of the reference: {:.2g} on average", m->label,
                         e.mean_abs),
             escaped(m->label)});
        result.rows.push_back(row);
    }
    pictures.key = key_of_changes();
    result.blocks = {std::move(table), std::move(pictures)};
    return result;
}

compared_frames compare_entering_frames(const settings& how, const std::filesystem::path& folder, steps& all)
{
    const frame_comparison frames("entering", how, folder, all, 2, [&](std::size_t i) {
        return entering_stage(double(how.width) / how.height, i == 1);
    });
    compared_frames result;
    pictures_block pictures{
        .title = "Changes as the dragon enters",
        .text =
            "The change of visibility from the scene without the dragon to the scene with it. Blue is "
            "brighter, red darker. Light above the dragon should not change.",
        .columns = 3,
        .pictures = {},
        .is_folded = false};
    pictures.pictures.push_back({frames.draw("traced-difference", frames.change_of(frames.traced())),
                                 "Change by ray tracing: darker on and below the dragon only",
                                 "reference: ray tracing"});
    for (const scattering_method* m : scattering_methods("entering")) {
        const std::vector<std::vector<float>> found = frames.frames_of(*m);
        const report_row row = frames.row(*m, found);
        pictures.pictures.push_back(
            {frames.draw(m->id + "-difference", frames.change_of(found)),
             fmt::format("Change by {}: {:.2g} off the change of the reference on average", m->label,
                         row.errors.mean_abs),
             fmt::format("{}: off by {:.2g} thousandths on average", escaped(m->label), 1e3 * row.errors.mean_abs)});
        result.rows.push_back(row);
    }
    pictures.key = key_of_changes();
    result.blocks = {std::move(pictures)};
    return result;
}

} // namespace gnomon::evaluation
