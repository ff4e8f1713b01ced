// Of many samples for each texel, 128 where Andersson et al. 2015 compare with it: hardly any noise of the map is left, so
// one seed stands for all.
#include "deep_layers.hpp"
#include "evaluation/core/timing.hpp"

namespace gnomon::evaluation {

namespace {

class layers_of_samples final : public deep_layers {
  public:
    layers_of_samples(const layered_input& from, int samples, float tolerance)
    {
        resolution = from.resolution;
        const std::size_t texels = std::size_t(resolution) * std::size_t(resolution), each = std::size_t(samples);
        std::vector<float> depths(texels * each);
        sampling_ms =
            1e3 * seconds_on_one_core([&] {
                for (int part = 0; part < samples; part += at_once) { // all at once take too much memory
                    const auto some =
                        renderer::rasterize_samples(from.stage.world, from.stage.light, resolution, resolution,
                                                    {.samples = at_once, .seed = deep_seed + std::uint32_t(part)});
                    for (std::size_t i = 0; i < texels; ++i)
                        for (std::size_t k = 0; k < std::size_t(at_once); ++k)
                            depths[i * each + std::size_t(part) + k] = some.of[i * std::size_t(at_once) + k].z;
                }
            });
        conversion_ms = 1e3 * seconds_on_one_core([&] { compress(std::span(depths), each, tolerance); });
    }

    static constexpr int at_once = 16;

  private:
    static constexpr std::uint32_t deep_seed = 0x1000000;
};

class deep_samples final : public layered_method {
  public:
    deep_samples()
        : layered_method({.id = "deep_samples",
                          .family = "deep",
                          .label = "deep",
                          .order = 40,
                          .map = deep_kind->id,
                          .format = {"deep_12b", "12 B layers"}},
                         {{.parameters = {{"samples", 32}, {"tolerance", usual_deep_tolerance}},
                           .label = "32 samples",
                           .comparisons = {equal_time, equal_memory}},
                          {.parameters = {{"samples", 128}, {"tolerance", usual_deep_tolerance}},
                           .label = "128 samples",
                           .comparisons = {of_settings}}},
                         false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        return std::make_unique<layers_of_samples>(from, int(how.at("samples")), float(how.at("tolerance")));
    }
};

const registered<deep_samples> entry;

} // namespace

} // namespace gnomon::evaluation
