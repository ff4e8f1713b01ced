// The samples in the window around a tile, one array for each of their numbers, so that compilers make packs of loops over
// them. A batch holds what fits in the nearest cache, mostly the whole window.
#ifndef GNOMON_PASSES_LAYER_WINDOW_HPP
#define GNOMON_PASSES_LAYER_WINDOW_HPP

#include "layer_map.hpp"

GNOMON_NAMESPACE_BEGIN
namespace detail {

/// The texels of the light's map in the window around a tile: columns x0 to x1 - 1, rows y0 to y1 - 1; and the tile's
/// centre.
struct tile_window {
    std::size_t x0, x1, y0, y1;
    float x, y;
};

inline tile_window window_around(const sample_map<float>& samples, const layer_settings& s, std::size_t column,
                                 std::size_t row)
{
    const std::size_t margin = (s.guard - s.tile) / 2;
    const auto from = [&](std::size_t tile) { return tile * s.tile - (std::min)(tile * s.tile, margin); };
    const auto to = [&](std::size_t tile, std::size_t extent) {
        return (std::min)((tile + 1) * s.tile + margin, extent);
    };
    const auto centre = [&](std::size_t tile) { return float(tile * s.tile) + 0.5f * float(s.tile); };
    return {from(column), to(column, samples.width), from(row), to(row, samples.height), centre(column), centre(row)};
}

/// Samples by number, with places from the tile's centre, and their middle depths. Behind the last are some of the
/// background, up to a multiple of `lanes`.
struct sample_batch {
    static constexpr std::size_t most = 1024, lanes = 16;
    using numbers = std::array<float, most>;
    numbers x, y, t, z, d_x, d_y, d_z, middle;
    std::size_t count = 0;

    /// A sample without its id.
    stochastic_sample<float> operator[](std::size_t k) const
    {
        return {x[k], y[k], t[k], z[k], d_x[k], d_y[k], d_z[k], 0};
    }
    std::size_t rounded() const { return (count + lanes - 1) / lanes * lanes; }
    void add(std::span<const stochastic_sample<float>> samples, float centre_x, float centre_y)
    {
        const stochastic_sample<float>* const from = samples.data();
        const std::size_t begin = count, size = samples.size();
        for (std::size_t k = 0; k < size; ++k) {
            const stochastic_sample<float>& s = from[k];
            x[begin + k] = s.x - centre_x;
            y[begin + k] = s.y - centre_y;
            t[begin + k] = s.t;
            z[begin + k] = s.z;
            d_x[begin + k] = s.d_x;
            d_y[begin + k] = s.d_y;
            d_z[begin + k] = s.d_z;
            middle[begin + k] = layer_middle_depth(s);
        }
        count += size;
    }
    void fill_up()
    {
        for (std::size_t k = count; k < rounded(); ++k) {
            x[k] = y[k] = t[k] = d_x[k] = d_y[k] = d_z[k] = 0;
            z[k] = 1;
            middle[k] = float(layer_background_depth);
        }
    }
};

/// All samples of a window, batch after batch. They are gathered once if one batch holds them.
class window_samples {
  public:
    window_samples(const sample_map<float>& samples, const tile_window& w) : samples_(samples), w_(w), y_(w.y0)
    {
        gather();
        is_whole_ = y_ == w.y1;
    }

    /// Call f(batch) for all samples.
    void for_each_batch(const auto& f)
    {
        if (is_whole_) return f(std::as_const(batch_));
        for (y_ = w_.y0, k_ = 0; y_ < w_.y1;) {
            gather();
            f(std::as_const(batch_));
        }
    }

  private:
    void gather()
    {
        const std::size_t row = (w_.x1 - w_.x0) * samples_.samples;
        for (batch_.count = 0; y_ < w_.y1 && batch_.count < batch_.most;) {
            const std::size_t some = (std::min)(row - k_, batch_.most - batch_.count);
            batch_.add(samples_.of.subspan((y_ * samples_.width + w_.x0) * samples_.samples + k_, some), w_.x, w_.y);
            k_ += some;
            if (k_ < row) continue;
            ++y_;
            k_ = 0;
        }
        batch_.fill_up();
    }

    const sample_map<float>& samples_;
    tile_window w_;
    std::size_t y_, k_ = 0; // of the next sample
    bool is_whole_ = false;
    sample_batch batch_;
};

} // namespace detail
GNOMON_NAMESPACE_END
#endif
