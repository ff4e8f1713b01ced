#include "scattering_comparison.hpp"

#include "evaluation/scattering/view_rays.hpp"
#include "renderer/vulkan/scene.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/depth.h>
#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/rectify.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/scattering/single_scattering.h>
#include <gnomon/storage/formats.hpp>

#include <tbb/parallel_for.h>
#include <vulkan/vulkan_format_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

template <class Format> using format_texels = std::vector<format_texel<Format>>;

// Level 0 of a map of one image or two, whose texels follow one another in the format's texel.
template <class Format>
format_texels<Format> read_texels(const vulkan::device& gpu, const std::vector<vulkan::image>& images)
{
    const auto [width, height] = images.front().extent();
    format_texels<Format> result(std::size_t(width) * height);
    std::size_t offset = 0;
    for (const vulkan::image& one : images) {
        const std::size_t bytes = vk::blockSize(one.format());
        const vulkan::buffer pixels(gpu, result.size() * bytes, vk::BufferUsageFlagBits::eTransferDst);
        gpu.run([&](const vk::raii::CommandBuffer& commands) { vulkan::copy(commands, one, pixels); });
        const std::byte* source = pixels.mapped<std::byte>().data();
        for (std::size_t i = 0; i < result.size(); ++i)
            std::memcpy(reinterpret_cast<std::byte*>(&result[i]) + offset, source + i * bytes, bytes);
        offset += bytes;
    }
    return result;
}

template <class Format>
texel_difference difference(const format_texels<Format>& device, const format_texels<Format>& host, double codes)
{
    std::vector<double> values;
    texel_difference result{.texels = device.size()};
    for (std::size_t i = 0; i < device.size(); ++i) {
        const auto a = load_channels<Format>(device[i]), b = load_channels<Format>(host[i]);
        double largest = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            largest = std::max(largest, std::round(codes * std::abs(double(a[k]) - double(b[k]))));
        values.push_back(largest);
        result.mean += largest / double(device.size());
        if (largest > 0) ++result.differing;
        if (largest > 1) ++result.by_more_than_one;
    }
    std::ranges::sort(values);
    result.p99 = values[std::size_t(0.99 * double(values.size() - 1))];
    result.largest = values.back();
    return result;
}

template <class T> void in_bands(std::size_t rows, const T& pass)
{
    tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t y) { pass(row_range{y, y + 1}); });
}

template <class Real> auto bounds_of(const hankel4<Real>& h, Real z_f) { return hamburger4_bounds(h, z_f); }
template <class Real> auto bounds_of(const hankel6<Real>& h, Real z_f) { return hamburger6_bounds(h, z_f); }

// The CPU's part for a format.
template <class Format> class host_side {
  public:
    using texel = format_texel<Format>;
    using texels = format_texels<Format>;

    host_side(const rectified_scene& rectified, const light_map& light) : rectified_(rectified), light_(light) {}

    texels from_depths(const image<float>& depths) const
    {
        const map_view<const float> source{depths.pixels, std::size_t(depths.width), std::size_t(depths.height)};
        return made([&](map_view<texel> map, row_range band) {
            rectify<Format>(source, light_, rectified_.frame, rectified_.rows, map, band);
        });
    }

    texels from_moments(mip_view<const moments4_unorm16::texel> moments) const
    {
        return made([&](map_view<texel> map, row_range band) {
            rectify_moments<Format, moments4_unorm16>(moments, light_, rectified_.frame, rectified_.rows, map, band);
        });
    }

    texels averages(texels of) const
    {
        in_bands(rows(), [&](row_range band) {
            transmittance_prefix<Format>({of, rectified_.columns, rows()}, rectified_.rows, band);
        });
        return of;
    }

    std::vector<float> visibilities(texels averages, std::span<const view_segment> where) const
    {
        averages.resize(mip_texels(rectified_.columns, rows()));
        const mip_view<texel> mips{averages, rectified_.columns, rows()};
        build_mips<Format>(mips);
        std::vector<float> result(where.size());
        tbb::parallel_for(std::size_t{0}, where.size(),
                          [&](std::size_t i) { result[i] = visibility(mips, rays_of<float>(where, i)); });
        return result;
    }

  private:
    std::size_t rows() const { return rectified_.rows.size(); }

    texels made(const auto& pass) const
    {
        texels result(rectified_.columns * rows());
        in_bands(rows(), [&](row_range band) { pass({result, rectified_.columns, rows()}, band); });
        return result;
    }

    float visibility(mip_view<const texel> mips, const view_rays<float>& to) const
    {
        const rectified_ray ray = rectified_.ray(to);
        const auto c = rectified_channels<Format>(mips, rectified_.frame, rectified_.rows, ray.position, ray.level);
        const float depth = rectified_depth_at(rectified_.frame, rectified_.rows, ray.position);
        const float beta = adaptive_overestimation(rectified_cosine(to.x, to.y, to.z));
        return 1 - bounds_intensity(bounds_of(Format::filtered_factor(c), depth), beta);
    }

    const rectified_scene& rectified_;
    const light_map& light_;
};

shading::rectified_view seen_from(const scattering_view& view, const scattering_scene& scene,
                                  const rectified_scene& rectified)
{
    const camera& eye = view.stage.eye;
    const medium& air = view.stage.air;
    const auto ray = [&](double u, double v) {
        return glm::vec4(in_light_axes(view.stage.light, ray_through(eye, {u, v}).direction), 0);
    };
    const rectified_frame& frame = rectified.frame;
    const light_map& map = scene.map;
    const auto columns = float(rectified.columns), rows = float(rectified.rows.size());
    return {.eye = {map.x, map.y, map.z, view.depths.centres.width},
            .light = {map.texels_x, map.texels_y, 1 / map.depths, frame.depth == rectified_depth::cosine},
            .frame = {frame.radius, frame.azimuth_start, frame.azimuth_length, frame.wraps()},
            .texel = {rectified_radius_step(frame, rectified.columns), frame.azimuth_length / rows, columns, rows},
            .corner = ray(0, 0),
            .right = ray(1, 0) - ray(0, 0),
            .down = ray(0, 1) - ray(0, 0),
            .planes = {eye.near_distance, eye.far_distance, 2 * eye.half_extent.x / view.seen.width, air.asymmetry},
            .scattering = {air.scattering, 0},
            .extinction = {air.extinction(), 0},
            .irradiance = {air.irradiance, 0}};
}

// View rays to what the device has in its depth buffer.
std::vector<view_segment> segments_of(const image<float>& depths, const camera& eye,
                                      const shading::rectified_view& seen)
{
    const double near = eye.near_distance, far = eye.far_distance;
    std::vector<view_segment> result;
    for (int y = 0; y < depths.height; ++y)
        for (int x = 0; x < depths.width; ++x) {
            const double ahead = near * far / (far - double(depths(x, y)) * (far - near));
            const glm::dvec2 uv((x + 0.5) / depths.width, (y + 0.5) / depths.height);
            const glm::dvec4 ray =
                glm::dvec4(seen.corner) + uv.x * glm::dvec4(seen.right) + uv.y * glm::dvec4(seen.down);
            result.push_back({glm::vec3(ahead * ray), float(ahead) * seen.planes.z});
        }
    return result;
}

bool supports(const vulkan::device& gpu, const scattering_format& format)
{
    using feature = vk::FormatFeatureFlagBits;
    const auto needed =
        feature::eStorageImage | feature::eSampledImageFilterLinear | feature::eBlitSrc | feature::eBlitDst;
    return gpu.physical().getFeatures().shaderStorageImageWriteWithoutFormat &&
           std::ranges::all_of(format.images, [&](vk::Format image) {
               return (gpu.physical().getFormatProperties(image).optimalTilingFeatures & needed) == needed;
           });
}

// Of surfaces, whose shadow map is not blurred.
constexpr double bilinear_radius = 1.5;

// All that comparisons of a stage share.
struct both_sides {
    const vulkan::device& gpu;
    const scattering_view& view;
    const scattering_scene scene;
    const rectified_scene rectified;
    const shading::rectified_view seen;
    const device_stage drawn;
    const rectified_stage stage;

    both_sides(const vulkan::device& its_gpu, const scattering_view& its_view, const settings& how,
               const rectified_options& options)
        : gpu(its_gpu),
          view(its_view),
          scene(its_view.scene()),
          rectified(scene, options),
          seen(seen_from(view, scene, rectified)),
          drawn(gpu, view.stage, {std::uint32_t(view.seen.width), std::uint32_t(view.seen.height)}, how.map_resolution,
                how.hlsl ? shading_language::hlsl : shading_language::glsl, {}, bilinear_radius),
          stage(drawn, seen, rectified.rows, rectified.columns, rectified.frame.wraps())
    {}
};

// Signed depths of the device's shadow map.
image<float> signed_depths(const vulkan::device& gpu, const vulkan::image& depths)
{
    image<float> result = vulkan::read_back<float>(gpu, depths);
    for (float& z : result.pixels) z = depth_from_unit(z);
    return result;
}

template <class Format>
scattering_comparison compare_format(const both_sides& on, scattering_format format, double codes)
{
    const rectified_device_map map(on.stage, format);
    std::vector<named_pass> passes = on.stage.drawing();
    for (named_pass& one : map.passes()) passes.push_back(std::move(one));
    scattering_comparison result;
    result.format = std::move(format);
    result.name = std::string(Format::name);
    result.texels = on.rectified.columns * on.rectified.rows.size();
    result.bytes_per_texel = double(Format::bytes_per_texel);
    result.codes = codes;
    result.device = on.drawn.run(passes, on.stage.picture());
    result.look_up_tolerance = 0x1p-9f + float(Format::bias_weight);
    result.whole_tolerance = tolerance_of(on.gpu, 0.25f);
    const host_side<Format> host(on.rectified, on.scene.map);
    const auto compared = [&](const rectified_device_map::images& device, const format_texels<Format>& reference) {
        return difference<Format>(read_texels<Format>(on.gpu, device), reference, codes);
    };
    result.nearest = compared(map.nearest(), host.from_depths(signed_depths(on.gpu, on.stage.depths())));
    const format_texels<Format> own = host.from_moments(on.view.depths.filtered());
    result.filtered = compared(map.filtered(), own);
    const format_texels<Format> averages = host.averages(read_texels<Format>(on.gpu, map.filtered()));
    result.groups = compared(map.by_groups(), averages);
    if (on.gpu.shuffling_lanes() > 0) result.subgroups = compared(map.by_subgroups(), averages);

    const image<float>& seen = result.device.visibility;
    std::vector<std::size_t> pixels(seen.pixels.size());
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
    const auto pictured = [&](std::vector<float> visibility) {
        image<float> picture(seen.width, seen.height);
        picture.pixels = std::move(visibility);
        return picture;
    };
    const auto there =
        segments_of(vulkan::read_back<float>(on.gpu, on.drawn.camera_depth()), on.view.stage.eye, on.seen);
    result.of_look_up =
        difference_of(seen, pictured(host.visibilities(read_texels<Format>(on.gpu, map.by_groups()), there)), pixels,
                      result.look_up_tolerance);
    result.host = pictured(host.visibilities(host.averages(own), on.view.where));
    result.of_whole = difference_of(seen, result.host, pixels, result.whole_tolerance);
    return result;
}

} // namespace

std::string paper_method(const scattering_format& format)
{
    return "scatter" + format.id.substr(std::string("moments").size()) + "_paper_filtered";
}

std::vector<scattering_comparison> compare_scattering(const vulkan::device& gpu, const scattering_view& view,
                                                      const settings& how, const rectified_options& options)
{
    const both_sides both(gpu, view, how, options);
    std::vector<scattering_comparison> result;
    const auto add = [&]<class Format>(std::vector<vk::Format> images, double codes) {
        scattering_format format{std::string(Format::id), std::move(images)};
        if (supports(gpu, format)) result.push_back(compare_format<Format>(both, std::move(format), codes));
    };
    add.operator()<moments4_unorm16>({vk::Format::eR16G16B16A16Unorm}, 65535);
    add.operator()<moments6_unorm10>({vk::Format::eA2B10G10R10UnormPack32, vk::Format::eA2B10G10R10UnormPack32}, 1023);
    add.operator()<moments6_unorm16>({vk::Format::eR16G16B16A16Unorm, vk::Format::eR16G16Unorm}, 65535);
    return result;
}

} // namespace gnomon::evaluation
