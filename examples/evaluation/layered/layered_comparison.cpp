#include "layered_comparison.hpp"

#include "evaluation/core/timing.hpp"
#include "layered_view.hpp"
#include "seed_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <list>
#include <memory>
#include <stdexcept>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

// Constants of the bias, of signed depth. Of a large picture every second column and row is looked up for a curve.
constexpr std::array bias_constants{0., .0025, .005, .01, .02, .04, .08, .16, .32};
constexpr int large_width = 160;

// A variant while it is measured: its map, and what is known at each constant bias.
struct tracked_bias {
    double constant;
    seed_statistics statistics;
    std::vector<float> held; // the estimate with the samples of the camera's first seed
};
struct tracked_variant {
    const layered_method* method;
    const layered_variant* variant;
    int seeds;
    bool with_curve;
    std::unique_ptr<layered_map> map;
    std::vector<tracked_bias> biases{};
    layered_result result{};
};

bool has(const layered_variant& v, std::string_view comparison)
{
    return std::ranges::count(v.comparisons, comparison) > 0;
}

std::vector<const layered_method*> layered_methods()
{
    std::vector<const layered_method*> result;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const layered_method*>(m)) result.push_back(one);
    // The exact method comes first, since others are compared with it.
    std::stable_partition(result.begin(), result.end(), [](const layered_method* m) { return m->id == exact_method; });
    if (result.empty() || result.front()->id != exact_method) throw std::logic_error("no exact visibility");
    return result;
}

class layers_comparison {
  public:
    layers_comparison(const motion_scene& scene, const layered_sizes& size, const std::filesystem::path& folder)
        : size_(size),
          folder_(folder),
          stage_(scene.stage(double(size.width) / size.height, size.full)),
          view_(stage_, {size.width, size.height, size.camera_samples, size.reference_times}),
          input_(stage_, size.map_resolution, 0),
          found_{.scene = scene, .motion = scene.motion}
    {
        found_.map_resolution = size.map_resolution;
        found_.triangles = triangle_numbers(stage_.world.open).count();
        found_.receivers = static_cast<long long>(view_.pixels.size());
        found_.penumbra_pixels = static_cast<long long>(view_.penumbrae.size());
        found_.reference = file("reference");
        write_png(folder_ / found_.reference, view_.reference.colour);
        for (const layered_method* m : layered_methods())
            for (const layered_variant& v : m->variants) begin(*m, v);
    }

    compared_layers run()
    {
        for (int seed = 0; seed < size_.seeds; ++seed) {
            // Seeds of map and camera differ: equal ones would give a sample of both the same time.
            input_.reseed(std::uint32_t(2 * seed));
            view_.reseed(std::uint32_t(2 * seed + 1));
            for (tracked_variant& t : tracked_)
                if (seed < t.seeds) measure(t, seed);
            if (seed == 0) found_.samples_of_map = static_cast<long long>(input_.samples().of.of.size());
        }
        found_.camera_ms = view_.now().of.camera_ms;
        for (tracked_variant& t : tracked_) finish(t);
        return std::move(found_);
    }

  private:
    std::string file(std::string_view what) const { return fmt::format("{}-{}.png", found_.scene.id, what); }

    void begin(const layered_method& m, const layered_variant& v)
    {
        const bool rival = (has(v, equal_time) || has(v, equal_memory)) && (found_.motion.has("rivals") || size_.full);
        const bool is_shown = v.scene.empty() ? found_.motion.has("settings") : found_.scene.id == v.scene;
        const bool setting = has(v, of_settings) && (is_shown || size_.full);
        if (!v.without.empty() && found_.motion.has(v.without) && !size_.full) return;
        // Models of depth differ little from the usual one in noise.
        const bool model = m.family == layers_family->id && m.id != usual_layers;
        const int all = model ? std::max(size_.seeds / 2, 2) : size_.seeds;
        const int seeds = has(v, equal_input) ? all : rival || setting ? size_.few_seeds : 0;
        if (seeds > 0)
            tracked_.push_back({&m, &v, seeds, m.id != exact_method && (rival || has(v, equal_input)), nullptr});
    }

    int resolution_of(const tracked_variant& t) const
    {
        return t.map->resolution > 0 ? t.map->resolution : size_.map_resolution;
    }

    // The visibility of each segment, and the time of the look-ups where there is no constant bias.
    static std::vector<float> look_up(const tracked_variant& t, double constant, const stochastic_receivers& all,
                                      double* ms = nullptr)
    {
        std::vector<float> found(all.where.size());
        if (constant == 0) {
            const double spent = seconds_on_one_core([&] { t.map->visibilities(all.where, found); });
            if (ms) *ms = 1e3 * spent;
        } else {
            std::vector<stochastic_receiver> where = all.where;
            for (stochastic_receiver& r : where) r = with_bias(r, float(constant));
            t.map->visibilities(where, found);
        }
        return of_segments(all, found);
    }

    void measure(tracked_variant& t, int seed)
    {
        if (!t.map || t.method->is_seeded) t.map = t.method->build(input_, t.variant->parameters);
        if (seed == 0) {
            t.biases.push_back({0, {view_.expected, view_.penumbrae}, {}});
            if (t.with_curve) add_curve(t);
        }
        for (tracked_bias& b : t.biases) {
            double ms = 0;
            const int texels = resolution_of(t);
            const std::vector<float> segments = look_up(t, b.constant, view_.now().receivers(texels), &ms);
            if (t.method->id == exact_method) exact_ = view_.of_penumbrae(view_.now(), segments), over_parts_.clear();
            if (seed == 0) b.held = view_.of_penumbrae(view_.now(), segments);
            else if (t.method->is_seeded) {
                // Neighbours that a look-up draws belong to the map's noise.
                stochastic_receivers some = view_.in_penumbrae(view_.first(), texels);
                draw_choices(some, input_.seed);
                b.held = view_.of_penumbrae(view_.first(), look_up(t, b.constant, some));
            }
            b.statistics.add(view_.of_pixels(view_.now(), segments),
                             {exact_, t.seeds > 1 ? exact_over_parts(t) : exact_, b.held});
            if (b.constant == 0) note(t, seed, ms, segments);
        }
        if (t.method->is_seeded) t.map.reset();
    }

    // Exact visibility in penumbrae over the parts of time that the map's look-ups average, of this seed of the camera.
    // Methods that average the same parts share it.
    const std::vector<float>& exact_over_parts(const tracked_variant& t)
    {
        const stochastic_receivers& some = view_.in_penumbrae(view_.now(), resolution_of(t));
        std::vector<shutter_exposure<float>> parts;
        for (const stochastic_receiver& r : some.where) parts.push_back(t.map->averaged(r));
        const auto alike = [](const shutter_exposure<float>& a, const shutter_exposure<float>& b) {
            return a.begin == b.begin && a.end == b.end;
        };
        const auto found = std::ranges::find_if(
            over_parts_, [&](const auto& one) { return std::ranges::equal(one.first, parts, alike); });
        if (found != over_parts_.end()) return found->second;
        std::vector<float> exact = view_.exact_in_penumbrae(view_.now(), some, parts);
        return over_parts_.emplace_back(std::move(parts), std::move(exact)).second;
    }

    // Times, the least of all seeds, and facts and a picture of the first seed.
    void note(tracked_variant& t, int seed, double look_up_ms, const std::vector<float>& segments)
    {
        layered_result& r = t.result;
        const auto least = [seed](double& of, double now) { of = seed == 0 ? now : std::min(of, now); };
        least(r.look_up_ms, look_up_ms), least(r.sampling_ms, t.map->sampling_ms);
        least(r.conversion_ms, t.map->conversion_ms);
        if (seed > 0) return;
        r.facts = t.map->facts;
        r.row.map_bytes = double(t.map->bytes());
        const double texels = double(t.map->resolution) * double(t.map->resolution);
        r.row.bytes_per_texel = texels > 0 ? r.row.map_bytes / texels : 0;
        draw(t, segments);
    }

    void draw(tracked_variant& t, const std::vector<float>& segments)
    {
        picture shaded;
        const double spent =
            seconds_on_one_core([&] { shaded = shade(stage_.world, stage_.light, view_.now().of.seen, segments); });
        if (t.method->id == exact_method) found_.shading_ms = 1e3 * spent;
        std::string name = t.method->id;
        for (const auto& [key, value] : t.variant->parameters) name += fmt::format("-{}_{:g}", key, value);
        t.result.picture = file(name), t.result.error = file(name + "-error");
        write_png(folder_ / t.result.picture, shaded);
        // Samples may miss what a pixel sees for a part of the time: errors are those of pixels that are measured.
        image<float> measured = view_.reference.visibility;
        const std::vector<float> estimate = view_.of_pixels(view_.now(), segments);
        for (std::size_t i = 0; i < estimate.size(); ++i) measured.pixels[view_.pixels[i]] = estimate[i];
        write_png(folder_ / t.result.error, error_picture(measured, view_.reference.visibility, layered_error_scale));
    }

    // Errors of a part of the pixels by the constant; the best constant is measured as the others are.
    void add_curve(tracked_variant& t)
    {
        const seen_motion& seen = view_.now().of.seen;
        const stochastic_receivers& all = view_.now().receivers(resolution_of(t));
        const std::size_t width = std::size_t(size_.width), stride = size_.width > large_width ? 2 : 1;
        const auto is_part = [&](std::size_t pixel) {
            return pixel % width % stride == 0 && pixel / width % stride == 0;
        };
        std::vector<char> in_part(seen.first.size() - 1);
        for (std::size_t pixel = 0; pixel < in_part.size(); ++pixel) in_part[pixel] = is_part(pixel);
        stochastic_receivers some = receivers_in(in_part, seen, all);
        std::vector<float> found(some.where.size()), expected;
        std::vector<std::size_t> part;
        for (std::size_t i = 0; i < view_.pixels.size(); ++i)
            if (is_part(view_.pixels[i])) part.push_back(i), expected.push_back(view_.expected[i]);
        bias_curve curve{t.method, t.variant, {}};
        double moved = 0;
        for (const double constant : bias_constants) {
            for (stochastic_receiver& r : some.where) r = with_bias(r, float(constant - moved));
            moved = constant;
            t.map->visibilities(some.where, found);
            const std::vector<float> of_all = view_.of_pixels(view_.now(), of_segments(some, found));
            std::vector<float> estimate;
            for (const std::size_t i : part) estimate.push_back(of_all[i]);
            const error_statistics e = compare(estimate, expected);
            curve.points.push_back({constant, e.leak, e.acne, e.rmse});
        }
        if (const double best = curve.best().constant; best != 0)
            t.biases.push_back({best, {view_.expected, view_.penumbrae}, {}});
        found_.curves.push_back(std::move(curve));
    }

    void finish(tracked_variant& t)
    {
        for (const tracked_bias& b : t.biases) {
            layered_result r = t.result;
            r.method = t.method, r.variant = t.variant, r.constant_bias = b.constant;
            r.row = row_of(*t.method);
            r.row.map_bytes = t.result.row.map_bytes, r.row.bytes_per_texel = t.result.row.bytes_per_texel;
            r.row.scene = found_.scene.id;
            r.row.receiver = camera_samples_kind->id;
            r.row.parameters = t.variant->parameters;
            r.row.parameters["camera_samples"] = size_.camera_samples;
            r.row.parameters["reference_times"] = size_.reference_times;
            if (b.constant != 0) r.row.parameters["bias"] = b.constant, r.picture.clear(), r.error.clear();
            r.row.label = r.label();
            r.row.reference = "traced";
            r.row.receivers = found_.receivers;
            r.row.errors = b.statistics.errors();
            r.row.noise = b.statistics.noise(), r.row.bias = b.statistics.bias();
            r.row.noise_beyond_exact = b.statistics.noise_beyond_exact();
            r.row.noise_beyond_camera = b.statistics.noise_beyond_camera();
            r.row.noise_of_map = b.statistics.noise_of_map();
            const double looked_up = double(view_.now().of.seen.segments.size());
            r.row.ns_per_receiver = 1e6 * r.look_up_ms / std::max(looked_up, 1.0);
            r.row.build_ms = r.build_ms();
            r.row.seeds = b.statistics.seeds();
            r.row.passes = {{"sampling", r.sampling_ms},
                            {"conversion", r.conversion_ms},
                            {"camera", found_.camera_ms},
                            {"look_up", r.look_up_ms},
                            {"shading", found_.shading_ms}};
            found_.results.push_back(std::move(r));
        }
    }

    layered_sizes size_;
    std::filesystem::path folder_;
    moving_stage stage_;
    layered_view view_;
    layered_input input_;
    compared_layers found_;
    std::vector<tracked_variant> tracked_;
    // Of this seed of the camera, in penumbrae: at the times of its samples, and over parts of time.
    std::vector<float> exact_;
    std::list<std::pair<std::vector<shutter_exposure<float>>, std::vector<float>>> over_parts_;
};

} // namespace

layered_sizes layered_sizes_of(const settings& how)
{
    const bool full = how.supersampling > 1, tiny = how.width < settings().width;
    const int shrink = full ? 1 : 4;
    return {.width = how.width / shrink,
            .height = how.height / shrink,
            .map_resolution = how.map_resolution / 2,
            .reference_times = full   ? 1024
                               : tiny ? 64
                                      : 256,
            .camera_samples = 4,
            .seeds = full   ? 16
                     : tiny ? 2
                            : 4,
            .few_seeds = full ? 4 : 1,
            .full = full};
}

bool layered_result::is_of(std::string_view comparison) const { return has(*variant, comparison); }

std::string layered_result::label() const
{
    std::string result = method->label;
    if (!variant->label.empty()) result += " " + variant->label;
    if (constant_bias != 0) result += fmt::format(", bias {:g}", constant_bias);
    return result;
}

const bias_point& bias_curve::best() const
{
    const double least = std::ranges::min(points, {}, &bias_point::rmse).rmse;
    return *std::ranges::find_if(points, [&](const bias_point& p) { return p.rmse <= 1.01 * least; });
}

const layered_result* compared_layers::usual(std::string_view method, bool best_bias) const
{
    const auto* of = dynamic_cast<const layered_method*>(registry_of<evaluation::method>().find(method));
    return of ? find(method, of->variants.front().parameters, best_bias) : nullptr;
}

const layered_result* compared_layers::find(std::string_view method, const parameters& how, bool best_bias) const
{
    const layered_result* found = nullptr;
    for (const layered_result& r : results)
        if (r.method->id == method && r.variant->parameters == how && (r.constant_bias == 0 || best_bias)) found = &r;
    return found;
}

compared_layers compare_layers(const motion_scene& scene, const layered_sizes& size,
                               const std::filesystem::path& folder)
{
    return layers_comparison(scene, size, folder).run();
}

} // namespace gnomon::evaluation
