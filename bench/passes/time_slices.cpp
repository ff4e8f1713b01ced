// Maps of samples that no cache holds, at random places and times: look-ups in slices of time, whose baseline reads depth
// alone, and in deep layers, whose baseline is the static receiver in the ranges that these come from; and the layers of
// 128 samples, whose baseline sorts their depths.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/deep_shadow.hpp>
#include <gnomon/passes/range/look_up.hpp>
#include <gnomon/passes/time_dependent.hpp>

namespace gnomon::bench {

namespace {

constexpr std::size_t side = 1024, slices = 4, receivers = 65536, at_once = 256;
constexpr std::size_t samples = 128, sampled_texels = 16;

class sliced_scene {
  public:
    sliced_scene() : first_(range_map<float>::texels(side, side) + 1), begins_(side * side + 1)
    {
        test::bit_source bits(1);
        const auto number = [&](double low, double high) { return static_cast<float>(bits.uniform(low, high)); };
        std::vector<stochastic_sample<float>> of;
        for (std::size_t i = 0; i < side * side * slices; ++i)
            of.push_back({0, 0, number(0, 1), number(-1, 1), number(-9, 9), number(-9, 9), number(-1, 1), 1});
        const sample_map<float> map{side, side, slices, of};
        const auto fill = [&](auto& texels) {
            texels.resize(of.size());
            fill_time_dependent(map, std::span(texels));
        };
        fill(depths_), fill(motions_), fill(all_);
        for (std::size_t i = 0; i < receivers; ++i)
            where_.push_back({number(0, side), number(0, side), number(-1, 1), number(0, 1), number(0, 0.01)});
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) { // one surface after the other
            const float t = number(0, 1);
            first_[i] = static_cast<std::uint32_t>(ranges_.size());
            ranges_.push_back({0, t, number(-1, 1), number(-1, 1), 1});
            ranges_.push_back({t, 1, number(-1, 1), number(-1, 1), 2});
        }
        first_.back() = static_cast<std::uint32_t>(ranges_.size());
        count_deep_layers(lists(), 0.f, std::span(begins_));
        layers_.resize(begins_.back());
        fill_deep_layers<float>(lists(), 0, begins_, std::span(layers_));
        for (std::size_t i = 0; i < samples * sampled_texels; ++i)
            unsorted_.push_back(static_cast<float>(bits.below(3)) / 2 - 0.75f + number(0, 0.1));
        sample_begins_.resize(sampled_texels + 1);
        shadows_.resize(receivers);
    }

    template <class Texel> work look_up(const std::vector<Texel>& texels, int look_ups)
    {
        return each([=, this, map = time_dependent_map<Texel>{side, side, slices, texels}](std::size_t i) {
            shadows_[i] = time_dependent_intensity(map, where_[i], look_ups);
        });
    }
    work depths(int look_ups) { return look_up(depths_, look_ups); }
    work motions() { return look_up(motions_, 1); }
    work all() { return look_up(all_, 1); }

    work in_ranges()
    {
        return each([this](std::size_t i) {
            const auto state = static_receiver_begin(where_[i].z, static_cast<float>(range_nothing), 0.f, 1.f);
            shadows_[i] = static_intensity(lists(), where_[i].x, where_[i].y, state);
        });
    }
    work in_layers()
    {
        return each([this](std::size_t i) {
            const deep_shadow_map<float> map{side, side, begins_, layers_};
            shadows_[i] = deep_intensity(map, where_[i].x, where_[i].y, where_[i].z);
        });
    }

    work sorted()
    {
        return {[this] {
                    sorted_ = unsorted_;
                    for (std::size_t i = 0; i < sorted_.size(); i += samples)
                        std::sort(sorted_.begin() + std::ptrdiff_t(i), sorted_.begin() + std::ptrdiff_t(i + samples));
                },
                double(unsorted_.size())};
    }
    work compressed()
    {
        return {[this] {
                    sorted_ = unsorted_;
                    count_deep_layers(std::span(sorted_), samples, 0.01f, std::span(sample_begins_));
                    sample_layers_.resize(sample_begins_.back());
                    fill_deep_layers<float>(sorted_, samples, 0.01f, sample_begins_, std::span(sample_layers_));
                },
                double(unsorted_.size())};
    }

  private:
    range_map<float> lists() const { return {side, side, first_, ranges_}; }

    // Works start at different receivers, so that none finds the data of another in a cache.
    template <class Look> work each(const Look& look)
    {
        return {[=, begin = starts_++ * (receivers / 2) % receivers]() mutable {
                    for (std::size_t i = begin; i < begin + at_once; ++i) look(i);
                    begin = (begin + at_once) % receivers;
                },
                double(at_once)};
    }

    std::size_t starts_ = 0;
    std::vector<slice_depth<float>> depths_;
    std::vector<slice_motion<float>> motions_;
    std::vector<time_dependent_sample<float>> all_;
    std::vector<time_dependent_receiver<float>> where_;
    std::vector<std::uint32_t> first_, begins_, sample_begins_;
    std::vector<depth_time_range<float>> ranges_;
    std::vector<deep_layer<float>> layers_, sample_layers_;
    std::vector<float> unsorted_, sorted_, shadows_;
};

sliced_scene& scene()
{
    static sliced_scene one;
    return one;
}

[[maybe_unused]] const bool registered =
    add_comparison(
        "slices/nearest texel", [] { return scene().depths(0); }, [] { return scene().depths(1); }) &&
    add_comparison(
        "slices/2 x 2, depth alone", [] { return scene().depths(1); }, [] { return scene().depths(1); }) &&
    add_comparison(
        "slices/2 x 2, motion in depth", [] { return scene().motions(); }, [] { return scene().depths(1); }) &&
    add_comparison(
        "slices/2 x 2, slope and motion", [] { return scene().all(); }, [] { return scene().depths(1); }) &&
    add_comparison(
        "deep layers/look-up", [] { return scene().in_layers(); }, [] { return scene().in_ranges(); }) &&
    add_comparison(
        "deep layers/of 128 samples, a sample", [] { return scene().compressed(); }, [] { return scene().sorted(); });

} // namespace

} // namespace gnomon::bench
