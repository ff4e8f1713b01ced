// The resolve of some thousand lists: a pack of texels at once, against one by one, the baseline. Ranges are like those
// of a rasterizer: surfaces that cross, each for a part of the shutter, the nearest first. Neighbouring texels see them
// at nearly the same times.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/simd/resolve.hpp>

namespace gnomon::bench {

namespace {

using pack = gnomon::pack<xsimd::batch<float>>;
constexpr std::size_t packs = 256; // more than branch predictors remember

/// Lists of `length` ranges.
template <std::size_t length> class lists {
  public:
    lists()
    {
        test::bit_source bits(1);
        const auto number = [&](double low, double high) { return static_cast<float>(bits.uniform(low, high)); };
        for (std::vector<range_row<pack>>& rows : rows_) {
            rows.resize(length);
            for (std::size_t k = 0; k < length; ++k) {
                const float t0 = number(-0.5, 1), t1 = t0 + number(0.1, 0.6), step = number(-0.01, 0.01);
                const float z0 = -0.9f + 1.8f * float(k) / length, z1 = z0 + number(-0.1, 0.1);
                for (std::size_t i = 0; i < pack::size; ++i) {
                    const float later = step * float(i);
                    rows[k].set(
                        i, range_clip(depth_time_range<float>{t0 + later, t1 + later, z0, z1, float(k)}, 0.f, 1.f));
                }
            }
        }
        for (const auto& rows : rows_)
            for (std::size_t i = 0; i < pack::size; ++i)
                for (const auto& row : rows) ranges_.push_back(row.range(i));
        spans_.resize(resolve_capacity(length, range_ids::surfaces));
    }

    work together()
    {
        return {[this] {
                    for (const auto& rows : rows_) {
                        some_ = rows;
                        resolve_rows<pack>(some_, fronts_, length);
                    }
                    benchmark::DoNotOptimize(fronts_.data());
                },
                double(ranges_.size())};
    }
    work one_by_one()
    {
        return {[this] {
                    const std::span<const depth_time_range<float>> all = ranges_;
                    for (std::size_t i = 0; i < all.size(); i += length)
                        resolve_ranges<float>(all.subspan(i, length), spans_, range_ids::surfaces);
                    benchmark::DoNotOptimize(spans_.data());
                },
                double(ranges_.size())};
    }

  private:
    std::array<std::vector<range_row<pack>>, packs> rows_;
    std::vector<depth_time_range<float>> ranges_;
    std::vector<range_row<pack>> some_;
    std::vector<front_row<pack>> fronts_;
    std::vector<visible_span<float>> spans_;
};

template <std::size_t length> lists<length>& lists_of()
{
    static lists<length> all;
    return all;
}

template <std::size_t length> bool add_rows(const char* together, const char* alone)
{
    const auto one_by_one = [] { return lists_of<length>().one_by_one(); };
    return add_comparison(
               together, [] { return lists_of<length>().together(); }, one_by_one) &&
           add_comparison(alone, one_by_one, one_by_one);
}

[[maybe_unused]] const bool registered =
    add_rows<4>("resolve/lists of 4/a pack at once", "resolve/lists of 4/one by one") &&
    add_rows<16>("resolve/lists of 16/a pack at once", "resolve/lists of 16/one by one") &&
    add_rows<64>("resolve/lists of 64/a pack at once", "resolve/lists of 64/one by one");

} // namespace

} // namespace gnomon::bench
