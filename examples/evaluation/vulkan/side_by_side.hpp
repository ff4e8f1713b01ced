// Methods on the CPU and on a Vulkan device: the same stage, the same receivers, the same weights.
//
// The kernels are one text, so what differs is what Vulkan leaves to a device: whether a product and a sum are fused,
// in which direction a stored half float is rounded, with how many bits a sampler weighs texels, how positions are
// interpolated, and how finely corners are snapped to the grid of samples. All but the last move the moments by no more
// than a few of the formats' roundings, which their biases and minimum variances are made to hide: on a lit surface
// they show as 1% of intensity at most (storage/formats.hpp). With corners snapped more coarsely than on the CPU, a
// straight edge may gain or lose one sample in each texel that it crosses, a quarter of a texel under the blur's
// largest weight. Hence the tolerance: 99% of the receivers keep it, and those that do not lie at an edge of a surface
// or of a shadow.
#pragma once

#include "evaluation/core/driver.hpp"
#include "evaluation/core/report.hpp"
#include "renderer.hpp"

#include <gnomon/passes/blur.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// Of the device's visibilities against the CPU's.
struct difference_statistics {
    error_statistics errors;
    double median, p99, p999;     // of the absolute difference
    double beyond, beyond_inside; // shares of receivers beyond the tolerance: of all, and away from edges
};

struct side_by_side {
    renderer::image<float> host; // visibility
    device_frame device;
    difference_statistics difference;
};

// Over the pixels of a picture of visibility.
difference_statistics difference_of(const renderer::image<float>& device, const renderer::image<float>& host,
                                    std::span<const std::size_t> pixels, float tolerance);

// The tolerance for visibilities that a filter averages, of which a texel has largest_weight at most.
float tolerance_of(const renderer::vulkan::device& gpu, float largest_weight);

class device_comparison {
  public:
    device_comparison(const renderer::vulkan::device& gpu, const renderer::stage& scenery, const settings& how);

    bool possible(const filterable_method& m) const { return renderer_.supports(device_method_of(m)); }
    side_by_side render(const filterable_method& m) const;

    difference_statistics difference(const renderer::image<float>& device, const renderer::image<float>& host,
                                     float tolerance) const
    {
        return difference_of(device, host, where_.pixels, tolerance);
    }

    float tolerance() const { return tolerance_; }
    const depth_map& depths() const { return depths_; }
    const renderer::image<renderer::surface>& seen() const { return seen_; }
    const map_receivers& where() const { return where_; }

  private:
    std::array<float, 9> taps_ = gaussian_weights();
    float tolerance_;
    depth_map depths_;
    renderer::image<renderer::surface> seen_;
    map_receivers where_;
    shadow_renderer renderer_;
};

} // namespace gnomon::evaluation
