// Building summed-area tables on one core, in one pass or two, and with the resolve of four depth samples. The baseline is
// one memcpy of the table's bytes. Maps of 1024 x 1024 texels; and look-ups of rectangles, on the grid and interpolated.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/summed_area.hpp>
#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <cstring>

namespace gnomon::bench {

namespace {

constexpr std::size_t side = 1024, most_texels = 784, places = 1024;

/// A map of that table's format, made once.
template <class Table> class summed_work {
  public:
    static summed_work& get()
    {
        static summed_work w;
        return w;
    }
    work copy()
    {
        return {[this] {
                    std::memcpy(copy_.data(), texels_.data(), texels_.size() * sizeof texels_[0]);
                    asm volatile("" : : "r"(copy_.data()) : "memory");
                },
                side * side};
    }
    work build()
    {
        return {[this] {
                    build_summed_area<Table>(map_view<const channels>{source_, side, side}, table(), most_texels);
                },
                side * side};
    }
    work build_and_resolve()
    {
        return {[this] {
                    build_summed_area<Table>(map_view<const depths>{depths_, side, side}, table(), most_texels);
                },
                side * side};
    }
    work two_passes()
    {
        return {[this] {
                    summed_area_along_x<Table>(map_view<const channels>{source_, side, side}, table(), most_texels,
                                               {0, side});
                    summed_area_along_y<Table>(table());
                },
                side * side};
    }
    work on_grid()
    {
        return look_ups(
            [this](const summed_area_rectangle<float>& r) { return grid_average<Table>(table(), most_texels, r); });
    }
    work interpolated()
    {
        return look_ups([this](const summed_area_rectangle<float>& r) {
            return rectangle_average<Table>(table(), most_texels, r);
        });
    }

  private:
    using depths = std::array<float, 4>;
    using channels = format_channels<Table>;

    summed_work() : source_(side * side), depths_(side * side), texels_(side * side), copy_(side * side)
    {
        test::bit_source bits(1);
        for (std::size_t i = 0; i < source_.size(); ++i) {
            for (float& z : depths_[i]) z = static_cast<float>(bits.uniform(-1, 1));
            source_[i] = Table::from_depth(depths_[i][0]);
        }
        for (auto& r : rectangles_)
            r = summed_area_around(static_cast<float>(bits.uniform(0, side)), static_cast<float>(bits.uniform(0, side)),
                                   27.0f, 27.0f);
        build().run();
    }
    map_view<format_texel<Table>> table() { return {texels_, side, side}; }

    template <class Average> work look_ups(Average average)
    {
        return {[this, average] {
                    for (const auto& r : rectangles_) {
                        auto c = average(r);
                        asm volatile("" : : "r"(&c) : "memory");
                    }
                },
                places};
    }

    std::vector<channels> source_;
    std::vector<depths> depths_;
    std::vector<format_texel<Table>> texels_, copy_;
    std::array<summed_area_rectangle<float>, places> rectangles_;
};

template <class Table> bool add_table_rows(const std::string& name)
{
    using w = summed_work<Table>;
    const auto add = [&](const char* what, auto measured, auto baseline) {
        return add_comparison((name + what).c_str(), measured, baseline);
    };
    const auto copy = [] { return w::get().copy(); };
    return add(
               "/one pass against memcpy", [] { return w::get().build(); }, copy) &&
           add(
               "/two passes against memcpy", [] { return w::get().two_passes(); }, copy) &&
           add(
               "/resolve and one pass against memcpy", [] { return w::get().build_and_resolve(); }, copy) &&
           add(
               "/look-up on the grid against interpolated", [] { return w::get().on_grid(); },
               [] { return w::get().interpolated(); });
}

[[maybe_unused]] const bool registered = add_table_rows<moments4_summed>("tables/four moments") &&
                                         add_table_rows<moments6_summed>("tables/six moments") &&
                                         add_table_rows<variance_summed>("tables/two moments");

} // namespace

} // namespace gnomon::bench
