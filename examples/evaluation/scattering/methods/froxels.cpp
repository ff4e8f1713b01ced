// A froxel grid of 160 x 90 x 64 (Wronski 2014), as most engines scatter light: one jittered look-up of the shadow map for each
// froxel, averages from the camera on, and a trilinear look-up for each pixel. Without a blend over earlier frames, by which
// engines hide the noise and which smears what moves.
#include "shadow_map_steps.hpp"

#include <gnomon/comparators/ray_march.h>
#include <gnomon/passes/froxels.hpp>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace gnomon::evaluation {

namespace {

constexpr std::size_t columns = 160, rows = 90, slices_count = 64;
constexpr float nearest_share = 1.f / 256; // of the farthest distance, where slice 0 ends

const registered<map_kind> froxel_kind{map_kind{.id = "froxels", .label = "froxels", .order = 63}};
const registered<family> froxel_family{family{.id = "froxels", .label = "froxels", .order = 18, .colour = "#e377c2"}};

class froxel_map final : public scattering_map {
  public:
    froxel_map(const scattering_scene& scene, bool jittered)
        : depths_(scene),
          right_(scene.corners[1] - scene.corners[0]),
          down_(scene.corners[3] - scene.corners[0]),
          corner_(scene.corners[0]),
          of_screen_(glm::inverse(glm::mat3(right_, down_, corner_))),
          slices_(slices_of(scene)),
          froxels_(columns * rows * slices_count)
    {
        time("look-ups", [&] { fill(jittered); });
        time("integral", [&] { integrate_froxels(grid(), slices_, scene.extinction, {0, rows}); });
    }

    std::size_t bytes() const override { return froxels_.size() * sizeof(float); }

    std::vector<build_pass> passes() const override { return passes_; }

    void visibilities(std::span<const view_segment> where, std::span<float> result) const override
    {
        visibilities_by_packs(where.size(), result,
                              [&]<class Real>(std::size_t group) { return intensity<Real>(where, group); });
    }

    std::vector<timed_look_up> timed(std::span<const view_segment> where) const override
    {
        return timed_whole(where.size(),
                           [this, where]<class Real>(std::size_t group) { return intensity<Real>(where, group); });
    }

  private:
    static froxel_slices<float> slices_of(const scattering_scene& scene)
    {
        float farthest = 0;
        for (const glm::vec3& c : scene.corners) farthest = std::max(farthest, glm::length(c));
        return froxel_slices_from(farthest * nearest_share, farthest, float(slices_count));
    }

    froxel_view<float> grid() { return {froxels_, columns, rows, slices_count}; }
    froxel_view<const float> grid() const { return {froxels_, columns, rows, slices_count}; }

    // One look-up for each froxel, by packs along its row.
    void fill(bool jittered)
    {
        constexpr std::size_t lanes = receiver_pack::size;
        static_assert(columns % lanes == 0);
        using real = receiver_pack;
        const map_vector<real> eye = depths_.eye<real>();
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < columns; x += lanes) {
                const real column = gathered<std::type_identity_t, real>([x](std::size_t i) { return float(x + i); });
                const real u = (column + real(0.5f)) * real(1.f / columns), v((float(y) + 0.5f) / rows);
                const auto along = [&](int axis) {
                    return real(corner_[axis]) + u * real(right_[axis]) + v * real(down_[axis]);
                };
                const real a = along(0), b = along(1), c = along(2);
                const real scale = real(1) / gnomon_sqrt(a * a + b * b + c * c);
                const map_vector<real> unit = depths_.vector(a * scale, b * scale, c * scale);
                float from = 0;
                for (std::size_t k = 0; k < slices_count; ++k) {
                    const float to = froxel_distance(float(k), slices_);
                    const real share =
                        jittered ? ray_march_jitter(column + real(float(17 * k)), real(float(y + 5 * k))) : real(0.5f);
                    const real distance = real(from) + share * real(to - from);
                    const map_vector<real> at = depths_.clamped(map_vector<real>{
                        eye.x + distance * unit.x, eye.y + distance * unit.y, eye.z + distance * unit.z});
                    gnomon_select(depths_.at(at.x, at.y) < at.z, real(1), real(0))
                        .store_unaligned(&grid().slice(k)(x, y));
                    from = to;
                }
            }
    }

    template <class Real> [[gnu::flatten]] Real intensity(std::span<const view_segment> where, std::size_t group) const
    {
        const view_rays<Real> to = rays_of<Real>(where, group);
        const auto screen = [&](int k) {
            return to.x * Real(of_screen_[0][k]) + to.y * Real(of_screen_[1][k]) + to.z * Real(of_screen_[2][k]);
        };
        const Real scale = Real(1) / screen(2);
        const Real x = screen(0) * scale * Real(float(columns)), y = screen(1) * scale * Real(float(rows));
        const froxel_slices<Real> slices{Real(slices_.nearest), Real(slices_.growth), Real(slices_.last)};
        const Real k = froxel_slice_of(gnomon_sqrt(to.x * to.x + to.y * to.y + to.z * to.z), slices);
        if constexpr (std::is_same_v<Real, float>) return froxel_intensity(grid(), x, y, k);
        else return between_froxels(x, y, k);
    }

    // The look-up of passes/froxels.hpp by packs.
    receiver_pack between_froxels(const receiver_pack& x, const receiver_pack& y, const receiver_pack& k) const
    {
        using real = receiver_pack;
        if constexpr (std::is_same_v<real, xsimd::batch<float>>) {
            using indices = xsimd::batch<std::int32_t>;
            const auto lower_of = [](const real& at, std::size_t extent) {
                return xsimd::to_int(gnomon_max(real(0), gnomon_min(at, real(float(extent - 1)))));
            };
            const auto upper_of = [](const indices& lower, std::size_t extent) {
                return xsimd::min(lower + 1, indices(std::int32_t(extent - 1)));
            };
            const auto fraction_of = [](const real& at, const indices& lower) {
                return gnomon_min(gnomon_max(at - xsimd::to_float(lower), real(0)), real(1));
            };
            const real px = x - real(0.5f), py = y - real(0.5f);
            const indices x0 = lower_of(px, columns), y0 = lower_of(py, rows), k0 = lower_of(k, slices_count);
            const indices x1 = upper_of(x0, columns), y1 = upper_of(y0, rows), k1 = upper_of(k0, slices_count);
            const real fx = fraction_of(px, x0), fy = fraction_of(py, y0), fk = fraction_of(k, k0);
            const auto mix = [](const real& low, const real& high, const real& t) { return low + t * (high - low); };
            const auto of_slice = [&](const indices& slice) {
                const auto of_row = [&](const indices& row) {
                    const indices first = (slice * std::int32_t(rows) + row) * std::int32_t(columns);
                    return mix(real::gather(froxels_.data(), first + x0), real::gather(froxels_.data(), first + x1),
                               fx);
                };
                return mix(of_row(y0), of_row(y1), fy);
            };
            return mix(of_slice(k0), of_slice(k1), fk);
        } else {
            alignas(real) std::array<std::array<float, real::size>, 3> at;
            x.store_aligned(at[0].data()), y.store_aligned(at[1].data()), k.store_aligned(at[2].data());
            return gathered<std::type_identity_t, real>(
                [&](std::size_t i) { return froxel_intensity(grid(), at[0][i], at[1][i], at[2][i]); });
        }
    }

    void time(const char* name, auto&& pass) { passes_.push_back({name, 1e3 * seconds_on_one_core(pass)}); }

    framed_depths<float> depths_;
    glm::vec3 right_, down_, corner_;
    glm::mat3 of_screen_; // column, row and distance shares of a place in light axes
    froxel_slices<float> slices_;
    std::vector<float> froxels_;
    std::vector<build_pass> passes_;
};

class froxel_method final : public scattering_method {
  public:
    froxel_method(const char* its_id, const char* its_label, double its_order, bool its_jittered)
        : scattering_method({.id = its_id,
                             .family = "froxels",
                             .label = its_label,
                             .order = its_order,
                             .map = "froxels",
                             .format = {"intensity_float", "32 bit intensity", sizeof(float)}}),
          jittered(its_jittered)
    {}

    std::unique_ptr<scattering_map> build(const scattering_scene& scene) const override
    {
        return std::make_unique<froxel_map>(scene, jittered);
    }

    const bool jittered;
};

const registered<froxel_method> with_jitter{"froxels", "froxels", 1.0, true};
const registered<froxel_method> without{"froxels_centred", "froxels, without jitter", 2.0, false};

} // namespace

} // namespace gnomon::evaluation
