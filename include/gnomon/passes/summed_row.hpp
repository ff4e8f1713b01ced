// Rows of a summed-area table, for passes/summed_area.hpp: codes of texels and their running sums. A texel is one or two
// vectors of the compiler, where it has any: no loop over channels is left to it.
#ifndef GNOMON_PASSES_SUMMED_ROW_HPP
#define GNOMON_PASSES_SUMMED_ROW_HPP

#include "../soft/summed_area.h"
#include "../storage/summed_texel.hpp"

#include <algorithm>
#include <cstring>
#include <span>

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The number of channels, of all that a texel has, that are one vector: 2 or 4.
template <std::size_t channels> inline constexpr std::size_t vector_channels = channels < 4 ? 2 : 4;

#if defined(__GNUC__)
template <std::size_t n> struct code_vector;
template <> struct code_vector<2> {
    static constexpr std::size_t n = 2;
    typedef std::uint32_t words __attribute__((vector_size(8)));
    typedef std::int64_t flags __attribute__((vector_size(16)));
    typedef std::int32_t whole __attribute__((vector_size(8)));
    typedef double numbers __attribute__((vector_size(16)));
    template <class Real> GNOMON_INLINE static void load(const Real* c, numbers& to)
    {
        to = numbers{double(c[0]), double(c[1])};
    }
    GNOMON_INLINE static void whole_of(const numbers& x, words& to)
    {
        to = reinterpret_cast<words>(__builtin_convertvector(x, whole));
    }
};
template <> struct code_vector<4> {
    static constexpr std::size_t n = 4;
    typedef std::uint32_t words __attribute__((vector_size(16)));
    typedef std::int64_t flags __attribute__((vector_size(32)));
    typedef std::int32_t whole __attribute__((vector_size(16)));
    typedef double numbers __attribute__((vector_size(32)));
    template <class Real> GNOMON_INLINE static void load(const Real* c, numbers& to)
    {
        to = numbers{double(c[0]), double(c[1]), double(c[2]), double(c[3])};
    }
    GNOMON_INLINE static void whole_of(const numbers& x, words& to)
    {
        to = reinterpret_cast<words>(__builtin_convertvector(x, whole));
    }
};

/// Add the codes of channels, clamped to [0, 1], to a sum, and note in odd where one is NaN. Codes are below 2^31, since
/// scales are for 4 texels and more.
template <class Vector, class Real>
GNOMON_INLINE void add_codes(const Real* c, double scale, typename Vector::words& sum, typename Vector::flags& odd)
{
    typename Vector::numbers x;
    Vector::load(c, x);
    odd |= x != x;
    x = x > 0.0 ? x : typename Vector::numbers{};
    x = x < 1.0 ? x : typename Vector::numbers{} + 1.0;
    typename Vector::words codes;
    Vector::whole_of(x * scale + 0.5, codes);
    sum += codes;
}

/// True if any channel is noted.
template <class Vector> bool any_odd(const typename Vector::flags& odd)
{
    bool any = false;
    for (std::size_t k = 0; k < Vector::n; ++k) any |= odd[k] != 0;
    return any;
}
#else
template <std::size_t count> struct code_vector {
    static constexpr std::size_t n = count;
    using flags = bool;
    struct words {
        std::array<std::uint32_t, n> w;
        words& operator+=(const words& b)
        {
            for (std::size_t k = 0; k < n; ++k) w[k] += b.w[k];
            return *this;
        }
    };
};

/// Add the codes of channels, clamped to [0, 1], to a sum, and note in odd where one is NaN. Codes are below 2^31, since
/// scales are for 4 texels and more.
template <class Vector, class Real>
void add_codes(const Real* c, double scale, typename Vector::words& sum, typename Vector::flags& odd)
{
    for (std::size_t k = 0; k < Vector::n; ++k) {
        odd |= !(c[k] == c[k]);
        const double x = c[k] > 0 ? (c[k] < 1 ? double(c[k]) : 1.0) : 0.0;
        sum.w[k] += std::uint32_t(std::int32_t(x * scale + 0.5));
    }
}

/// True if any channel is noted.
template <class Vector> bool any_odd(bool odd) { return odd; }
#endif

/// The texels of a row so far, summed up, and the row above.
template <class Table> class summed_row {
    static constexpr std::size_t channels = channel_count<Table>, n = vector_channels<channels>, parts = channels / n;
    static constexpr std::size_t rest = channels - parts * n; // 2 of six
    using texel = format_texel<Table>;
    using first = code_vector<n>;
    using last = code_vector<2>;

  public:
    summed_row(double scale, const texel* above, texel* row) : scale_(scale), above_(above), row_(row) {}

    /// Adds a texel of these channels, in [0, 1]; others are clamped.
    template <class Real> GNOMON_INLINE void add(const Real* c)
    {
        add_codes<first>(c, scale_, first_, odd_);
        typename first::words sum = first_;
        typename last::words end{};
        if constexpr (rest > 0) {
            add_codes<last>(c + n, scale_, last_, last_odd_);
            end = last_;
        }
        if (above_ != nullptr) {
            typename first::words a;
            std::memcpy(&a, above_->data(), sizeof a);
            sum += a;
            if constexpr (rest > 0) {
                typename last::words b;
                std::memcpy(&b, above_->data() + n, sizeof b);
                end += b;
            }
            ++above_;
        }
        std::memcpy(row_->data(), &sum, sizeof sum);
        if constexpr (rest > 0) std::memcpy(row_->data() + n, &end, sizeof end);
        ++row_;
    }

    /// True if any channel so far was NaN.
    [[nodiscard]] bool has_nan() const { return any_odd<first>(odd_) || any_odd<last>(last_odd_); }

  private:
    double scale_;
    const texel* above_;
    texel* row_;
    typename first::words first_{};
    typename last::words last_{};
    typename first::flags odd_{};
    typename last::flags last_odd_{};
};

/// Channels as they are.
template <summed_table Table> GNOMON_INLINE void add_texel(summed_row<Table>& row, const format_channels<Table>& c)
{
    row.add(gnomon_bit_cast<std::array<float, channel_count<Table>>>(c).data());
}

/// The mean of the channels of depth samples.
template <summed_table Table, std::size_t samples>
GNOMON_INLINE void add_texel(summed_row<Table>& row, const std::array<float, samples>& depths)
{
    row.add(gnomon_bit_cast<std::array<double, channel_count<Table>>>(Table::from_samples(depths)).data());
}

/// Sum up a row; true if a channel was NaN.
template <summed_table Table, class Source>
bool sum_known(std::span<const Source> source, double scale, const format_texel<Table>* above, format_texel<Table>* to)
{
    summed_row<Table> row(scale, above, to);
    if (above == nullptr)
        for (const Source& s : source) add_texel<Table>(row, s);
    else
        for (const Source& s : source) add_texel<Table>(row, s);
    return row.has_nan();
}

/// Sum up one row of a table: running sums of the codes on top of what is above, if there is anything. A row in which a channel is
/// NaN is summed up again, with the border in place of such texels.
template <summed_table Table>
void sum_row(std::span<const format_channels<Table>> source, double scale, const format_texel<Table>* above,
             format_texel<Table>* to)
{
    if (above != to && !sum_known<Table>(source, scale, above, to)) return; // a row on top of itself is summed up once
    const auto border = gnomon_bit_cast<std::array<double, channel_count<Table>>>(Table::from_depth(1.0));
    summed_row<Table> row(scale, above, to);
    for (const format_channels<Table>& c : source)
        if (are_known(c)) add_texel<Table>(row, c);
        else row.add(border.data());
}
template <summed_table Table, std::size_t samples>
void sum_row(std::span<const std::array<float, samples>> source, double scale, const format_texel<Table>* above,
             format_texel<Table>* to)
{
    sum_known<Table>(source, scale, above, to);
}

} // namespace detail

GNOMON_NAMESPACE_END
#endif
