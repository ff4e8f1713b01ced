// No kernel allocates, for any Real: operator new is replaced by one that counts.
#include "all_headers.hpp"
#include "kernels.hpp"
#include "pack.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <tuple>

namespace {

long allocations = 0;

void* count_and_allocate(std::size_t size, std::size_t alignment)
{
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) std::abort();
    return memory;
}

} // namespace

void* operator new(std::size_t size) { return count_and_allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment)
{
    return count_and_allocate(size, std::size_t(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace {

// Every parameter of a kernel is a Real, a struct of nothing else, or a scalar.
template <class Real, class T> T argument()
{
    if constexpr (std::is_arithmetic_v<T>) {
        return T(0.5);
    } else {
        static_assert(sizeof(T) % sizeof(Real) == 0 && std::is_trivially_copyable_v<T>);
        const Real half(gnomon::lane_t<Real>(0.5));
        T value;
        for (std::size_t i = 0; i < sizeof(T); i += sizeof(Real))
            std::memcpy(reinterpret_cast<char*>(&value) + i, &half, sizeof(Real));
        return value;
    }
}

template <class Real, class Result, class... Arguments> long allocations_of(Result (*kernel)(Arguments...))
{
    Result (*volatile opaque)(Arguments...) = kernel; // or the call might be dropped, its result being unused
    const std::tuple<Arguments...> arguments{argument<Real, Arguments>()...};
    const long before = allocations;
    std::apply(opaque, arguments);
    return allocations - before;
}

template <class Real> void check_every_kernel()
{
    using namespace gnomon;
#define CHECK_KERNEL(name, ...) CHECK_MESSAGE(allocations_of<Real>(&name<Real>) == 0, #name);
    GNOMON_FOR_EACH_KERNEL(CHECK_KERNEL)
}

} // namespace

TEST_CASE("the counter counts")
{
    const long before = allocations;
    int* volatile memory = new int(1);
    delete memory;
    CHECK(allocations == before + 1);
}

TEST_CASE("no kernel allocates")
{
    check_every_kernel<float>();
    check_every_kernel<double>();
#define CHECK_PACK(lanes, T) check_every_kernel<pack<T, lanes>>();
    FOR_EACH_PACK(CHECK_PACK)
}

TEST_CASE_TEMPLATE("no pass allocates", Format, gnomon::exponential_variance_half, gnomon::convolution_unorm8)
{
    using namespace gnomon;
    using texel = typename Format::texel;
    std::array<texel, mip_texels(12, 9)> texels{};
    std::array<texel, 12 * 9> scratch{};
    std::array<absorbance4_half::texel, 12 * 9> smoke{};
    const mip_view<texel> mips{texels, 12, 9};
    std::array<texel, 3 * 6 * 8 * 8> cube_texels{};
    const auto cube = [&](std::size_t k) {
        cube_view<texel> view;
        for (auto& face : view.faces) face = {std::span(cube_texels).subspan(64 * k++, 64), 8, 8};
        return view;
    };
    const auto weights = gaussian_weights();
    const long before = allocations;
    blur_cube<Format>(cube(0), cube(6), cube(12), weights);
    const float behind = Format::intensity(cube_bilinear<Format>(cube(12), 1.0f, 2.0f, 3.0f), 0.5f);
    const std::array<translucent_fragment, 2> fragments{{{3, 4, 0.5f, 0.5f}, {3, 4, -0.5f, 0.25f}}};
    blend<Format>(mips.level(0), fragments);
    accumulate<absorbance4_half>({smoke, 12, 9}, fragments);
    blur<Format>(mips.level(0), {scratch, 12, 9}, mips.level(0), weights);
    build_mips<Format>(mips);
    const float shadow = Format::intensity(trilinear<Format>(mips, 3.0f, 4.0f, 1.5f), 0.5f);
    const float smooth = Format::intensity(bicubic<Format>(mips, 3.0f, 4.0f, 1.5f), 0.5f);
    CHECK(allocations == before);
    CHECK(smooth >= 0);
    CHECK(shadow >= 0);
    CHECK(behind >= 0);
}

TEST_CASE("no pass of soft shadows allocates")
{
    using namespace gnomon;
    std::array<float, 40 * 9> depths{};
    std::array<depth_interval, depth_pyramid_blocks(40, 9)> blocks{};
    std::array<std::array<float, 1>, 40 * 9> samples{};
    std::array<moments4_summed::texel, 40 * 9> sums{};
    const map_view<moments4_summed::texel> table{sums, 40, 9};
    const depth_pyramid_view<depth_interval> pyramid{blocks, 40, 9};
    const long before = allocations;
    build_depth_pyramid<float>({depths, 40, 9}, pyramid);
    const depth_interval interval = depth_interval_in(pyramid, 1, 2, 33, 4);
    build_summed_area<moments4_summed>(map_view<const std::array<float, 1>>{samples, 40, 9}, table, 784);
    const auto channels = disc_average<moments4_summed>(table, 784, {1, 2, 33, 4});
    CHECK(allocations == before);
    CHECK(interval.greatest == 0);
    CHECK(moments4_summed::intensity(channels, 784.0f, 0.5f) > 0.9f);
}

TEST_CASE_TEMPLATE("no pass over rectified maps allocates", Format, gnomon::moments4_float, gnomon::moments6_unorm10)
{
    using namespace gnomon;
    using source = moments4_unorm16;
    std::array<float, 8 * 8> depths{};
    std::array<source::texel, mip_texels(8, 8)> moments{};
    std::array<typename Format::texel, mip_texels(12, 9)> texels{};
    std::array<rectified_row, 9> rows{};
    const mip_view<typename Format::texel> mips{texels, 12, 9};
    const map_view<typename Format::texel> map = mips.level(0);
    const light_map light{4, 4, 0, 1, 1, 1};
    const long before = allocations;
    const rectified_corners<float> far_plane{{4, -1, 1}, {4, 1, 1}, {4, 1, -1}, {4, -1, -1}};
    const rectified_frustum<float> bounds = rectified_frustum_from_corners(far_plane);
    const rectified_frame frame = rectified_frame_of(bounds);
    rectified_rows(frame, bounds, 0.5f, 12, rows);
    rectified_rows(frame, far_plane, 0.5f, 12, rows);
    rectify<Format>({depths, 8, 8}, light, frame, rows, map, {0, 9});
    rectify_filtered<Format>({depths, 8, 8}, light, frame, rows, map, {0, 9});
    rectify_moments<Format, source>({moments, 8, 8}, light, frame, rows, map, {0, 9});
    transmittance_prefix<Format>(map, rows, {0, 9});
    build_mips<Format>(mips);
    const rectified_position<float> end = rectified_from_position(3.0f, 0.5f, 0.25f);
    const auto channels = rectified_channels<Format>(mips, frame, rows, end, 0.5f);
    const float shadow = Format::filtered_intensity(channels, rectified_depth_at(frame, rows, end));
    CHECK(allocations == before);
    CHECK(shadow >= 0);
}

TEST_CASE("no pass over min-max rows or froxels allocates")
{
    using namespace gnomon;
    std::array<float, 128 * 2> depths{};
    std::array<depth_interval, min_max_nodes(128) * 2> nodes{};
    const map_view<depth_interval> tree{nodes, min_max_nodes(128), 2};
    const long before = allocations;
    build_min_max_rows({depths, 128, 2}, tree, {0, 2});
    const float shadow = min_max_intensity({depths, 128, 2}, tree, 0.9f, 1, 20.5f, 0.5f);
    std::array<float, 3 * 2 * 2> froxels{};
    const auto slices = froxel_slices_from(1.0f, 8.0f, 2.0f);
    integrate_froxels({froxels, 3, 2, 2}, slices, 0.5f, {0, 2});
    const float lit = froxel_intensity({froxels, 3, 2, 2}, 1, 1, froxel_slice_of(4.0f, slices));
    CHECK(allocations == before);
    CHECK(shadow == 1);
    CHECK(lit == 0);
}

TEST_CASE_TEMPLATE("no pass over summed-area tables allocates", Table, gnomon::moments4_summed, gnomon::moments6_summed,
                   gnomon::variance_summed)
{
    using namespace gnomon;
    std::array<std::array<float, 4>, 12 * 9> depths{};
    std::array<typename Table::texel, 12 * 9> texels{}, again{};
    std::array<typename Table::texel, 12> total{};
    const map_view<const std::array<float, 4>> source{depths, 12, 9};
    const map_view<typename Table::texel> table{texels, 12, 9}, second{again, 12, 9};
    const long before = allocations;
    build_summed_area<Table>(source, table, 100);
    summed_area_total<Table>(source, 100, {0, 9}, std::span(total));
    summed_area_along_x<Table>(source, second, 100, {0, 9});
    summed_area_along_y<Table>(second);
    const auto rectangle = summed_area_around(5.0f, 4.0f, 3.0f, 2.5f);
    const auto searched = grid_average<Table>(table, 100, rectangle);
    const float shadow = Table::intensity(rectangle_average<Table>(table, 100, rectangle), 100, 0.5f) +
                         Table::blocker(searched, 100, 0.5f);
    CHECK(allocations == before);
    CHECK(shadow >= 0);
    CHECK(texels == again);
}

TEST_CASE("no pass over ranges allocates")
{
    using namespace gnomon;
    using map = range_map<float>;
    const std::array<depth_time_range<float>, 3> loose{{{0, 0.75f, 0, 0, 1}, {0.25f, 1, -1, 1, 2}, {0, 1, 0.5f, 0, 3}}};
    std::array<visible_span<float>, resolve_capacity(3, range_ids::any)> spans{};
    std::array<std::uint32_t, 16> texels{};
    std::array<std::uint32_t, map::texels(12, 9) + 1> first{};
    std::array<depth_time_range<float>, texels.size()> some{}, ranges{};
    std::array<std::uint16_t, 2 * texels.size() + 1> begins{};
    std::array<std::uint64_t, begins.size()> bodies{};
    std::array<std::uint32_t, map::texels(12, 9) / compact_spans::group> groups{};
    std::array<std::uint16_t, map::texels(12, 9)> list_begins{};
    const std::array<placed_receiver<float>, 2> receivers{{{0, 1, {}}, {2, 3, {}}}};
    std::array<float, 2> shadows{};
    const receiver_path<float> path{{0, 1, 0, 0, 4}, 1, 1, 1, 5, 6, 1};
    const long before = allocations;
    const auto resolved = resolve_ranges<float>(loose, spans, range_ids::any);
    for (std::size_t i = 0; i < resolved.size(); ++i) some[i] = range_of<float>(loose, resolved[i]);
    sort_into_lists<float>(texels, some, first, ranges);
    const map lists{12, 9, first, ranges};
    static_intensities<float>(lists, receivers, shadows);
    std::array<stochastic_sample<float>, 12 * 9 * 2> samples{};
    const auto still = [](float, float, float, float) { return triangle_motion<float>{0, 0, 0}; };
    sample_ranges<map, float>(lists, 2, still, samples, {0, 9});
    const float shadow = static_intensity(lists, 0.5f, 0.5f, static_receiver_begin(0.f, 4.f, 0.f, 1.f)) +
                         moving_intensity(lists, path, 0.f, 1.f) + sampled_intensity(lists, path, 0.f, 16.f) +
                         crossed_intensity(lists, lists, line_receiver<float>{0.5f, 1.5f, 1, 4});
    some.fill({});
    const auto surfaces = resolve_ranges<float>(loose, spans, range_ids::surfaces);
    for (std::size_t i = 0; i < surfaces.size(); ++i) some[i] = range_of<float>(loose, surfaces[i]);
    sort_into_lists<float>(texels, some, first, ranges);
    const compact_range_map compact{12, 9, compact_ranges(lists, {begins, bodies, groups, list_begins})};
    const float same = static_intensity(compact, 0.5f, 0.5f, static_receiver_begin(0.f, 4.f, 0.f, 1.f)) +
                       moving_intensity(compact, path, 0.f, 1.f);
    const std::array<float, texels.size()> opacities{0.5f, 0.5f, 0.5f};
    const translucent_range_map<float> translucent{lists, opacities};
    const float veiled = static_intensity(translucent, 0.5f, 0.5f, static_receiver_begin(0.f, 4.f, 0.f, 1.f)) +
                         moving_intensity(translucent, path, 0.f, 1.f);
    CHECK(allocations == before);
    CHECK(shadow > 0);
    CHECK(same > 0);
    CHECK(veiled > 0);
}

TEST_CASE_TEMPLATE("no pass over layers allocates", Format, gnomon::layer_variance_half, gnomon::layer_moments4_float)
{
    using namespace gnomon;
    const layer_settings settings{.division = 1};
    std::array<stochastic_sample<float>, 12 * 8> samples{};
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = {float(i % 12) + 0.5f, float(i / 12) + 0.5f, 0.5f, 0, i % 12 < 4 ? 3.0f : 0.0f, 0, 0, 1};
    std::array<tile_clusters, 3 * 2> clusters{};
    std::array<std::uint32_t, clusters.size() + 1> first{};
    std::array<std::uint32_t, 1> blocks{};
    std::array<layer_grid<float>, 8> grids{};
    std::array<typename Format::texel, grids.size() * 85> texels{};
    std::array<typename Format::texel, layer_block * layer_block * 2> plain{};
    const long before = allocations;
    const sample_map<float> light{12, 8, 1, samples};
    layer_cluster(light, settings, clusters, {0, 2});
    const layer_counts counts = layer_allocate(settings, clusters, 12, 8, first, blocks);
    const auto some = std::span(grids).first(counts.layers);
    const auto in_layers = std::span(texels).first(counts.layers * layer_texels(settings));
    const auto in_blocks = std::span(plain).first(counts.blocks * block_texels(settings));
    const layer_map<typename Format::texel> map{12, 8, settings, first, blocks, some, in_layers, in_blocks};
    layer_accumulate<Format>(light, clusters, map, {0, 2});
    layer_mips<Format>(map, {0, 2});
    const layer_receiver<float> receiver{3, 3, 0.5f, 0.5f, 3, 3, 0.4f, 3, 3, 0.6f, 1, 0, 0, 0, 0};
    const float shadow = layer_intensity<Format>(map, receiver);
    CHECK(allocations == before);
    CHECK(counts.layers == grids.size()); // four tiles have both motions in their windows
    CHECK(counts.blocks == 1);
    CHECK(shadow == 1);
}

TEST_CASE("no pass over samples or deep layers allocates")
{
    using namespace gnomon;
    std::array<time_dependent_sample<float>, 48> slices{};
    std::array<float, 48> depths{};
    std::array<moments4_float::texel, 12> texels{};
    std::array<deep_layer<float>, 12> layers{};
    std::array<std::uint32_t, range_map<float>::texels(4, 3) + 1> first{};
    const long before = allocations;
    float shadow = time_dependent_intensity<time_dependent_sample<float>, float>({4, 3, 4, slices}, {2, 1, 1, 0, 0});
    fill_range_moments<moments4_float>(range_map<float>{4, 3, first, {}}, {texels, 4, 3});
    count_deep_layers<float>(depths, 4, 0, std::span(first).first(13));
    fill_deep_layers<float>(depths, 4, 0, std::span(first).first(13), layers);
    shadow += deep_intensity<float>({4, 3, std::span(first).first(13), layers}, 2, 1, 0.5f);
    CHECK((shadow == 2 && allocations == before));
}
