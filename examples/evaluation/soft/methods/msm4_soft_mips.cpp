// Search and filter by cubic B-splines over the mip chain of a map of four 16-bit moments, without a table: no largest
// search, and filters that are round. Lights that are no squares are taken for squares of their area.
#include "evaluation/soft/look_up.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/passes/bicubic.hpp>
#include <gnomon/soft/blocker.h>
#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

using format = moments4_unorm16;

const registered<map_kind> mips_kind{map_kind{.id = "mips", .label = "mip chain", .order = 40}};

class mip_map final : public soft_shadow_map {
  public:
    mip_map(const soft_depths& depths, const soft_light& light)
        : light_(light),
          width_(static_cast<std::size_t>(depths.samples.width)),
          height_(static_cast<std::size_t>(depths.samples.height)),
          texels_(mip_texels(width_, height_))
    {
        for (std::size_t i = 0; i < width_ * height_; ++i) {
            channel_array<format> sum{};
            for (const float z : depths.samples.pixels[i]) {
                const auto c = gnomon_bit_cast<channel_array<format>>(format::from_depth(z));
                for (std::size_t k = 0; k < c.size(); ++k) sum[k] += 0.25f * c[k];
            }
            texels_[i] = store_channels<format>(sum);
        }
        build_mips<format>({texels_, width_, height_});
    }

    std::size_t bytes() const override { return texels_.size() * sizeof texels_[0]; }

    void intensities(std::span<const soft_receiver> where, std::span<float> result) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i)
            result[i] = shadow(where[i], [&](const soft_widths<float>& widths) { return read(where[i], widths); });
    }

    std::vector<timed_look_up> timed(std::span<const soft_receiver> where) const override
    {
        std::vector<std::array<channels4<float>, 2>> values(where.size());
        tbb::parallel_for(std::size_t(0), where.size(), [&](std::size_t i) {
            std::size_t count = 0;
            shadow(where[i], [&](const auto& widths) { return values[i][count++] = read(where[i], widths); });
        });
        const auto kernels = [this, where, values = std::move(values)](std::span<float> result) {
            for (std::size_t i = 0; i < where.size(); ++i) {
                std::size_t count = 0;
                result[i] = shadow(where[i], [&](const auto&) { return values[i][count++]; });
            }
        };
        const auto all = [this, where](std::span<float> result) { intensities(where, result); };
        return {{1, {where.size(), kernels}, {where.size(), all}}};
    }

  private:
    channels4<float> read(const soft_receiver& where, const soft_widths<float>& widths) const
    {
        const mip_view<const format::texel> mips{texels_, width_, height_};
        return bicubic<format>(mips, where.x, where.y, mip_filter_level(std::sqrt(widths.x * widths.y)));
    }

    // Every level of the chain rounds once more: as many as a search region needs.
    hankel4<float> region(const channels4<float>& c) const
    {
        const float roundings = 2 + std::ceil(mip_filter_level(light_.widest_search));
        return hankel4_from_moments(theta4_inverse_add_bias(c, literal<float>(bias4_theta_b2),
                                                            roundings * literal<float>(stored4_unorm16_weight)));
    }

    float shadow(const soft_receiver& where, auto&& read_over) const
    {
        const hankel4<float> around = region(read_over(light_.penumbra(where.depth, -1.0f)));
        if (hamburger4_lower(around, where.depth) > 1 - umbra_epsilon) return 1;
        const soft_widths<float> widths = light_.penumbra(where.depth, blocker4_depth(around, where.depth));
        const hankel4<float> within = region(read_over(widths));
        return over_darken(hamburger4_lower(within, biased_depth(where, widths)), 1 - umbra_epsilon);
    }

    soft_light light_;
    std::size_t width_, height_;
    std::vector<format::texel> texels_;
};

class mip_method final : public soft_method {
  public:
    using soft_method::soft_method;

    std::unique_ptr<soft_shadow_map> build(const soft_depths& depths, const soft_light& light) const override
    {
        return std::make_unique<mip_map>(depths, light);
    }
};

const registered<mip_method> entry{
    method_facts{.id = "msm4_soft_mips",
                 .family = "msm4",
                 .label = "MSM soft, 4 moments, mips",
                 .order = 280,
                 .map = mips_kind->id,
                 .format = {std::string(format::id), std::string(format::name), double(sizeof(format::texel))}}};

} // namespace

} // namespace gnomon::evaluation
