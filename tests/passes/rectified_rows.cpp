// Rows of a rectified map that have a range of depth and a transmittance of a texel each: those of the view rays that read them.
#include "support/effort.hpp"
#include "support/far_planes.hpp"

#include <gnomon/passes/rectified_look_up.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t columns = 64;
constexpr float extinction = 0.25f;

struct rows_of_camera {
    rectified_corners<float> corners;
    rectified_frustum<float> bounds;
    rectified_frame frame;
    std::vector<rectified_row> rows{48};

    rows_of_camera(const rectified_corners<float>& far_plane, rectified_depth depth)
        : corners(far_plane),
          bounds(rectified_frustum_from_corners(far_plane)),
          frame(rectified_frame_of(bounds, depth))
    {
        rectified_rows(frame, corners, extinction, columns, rows);
    }
};

// The mean sine over the solid angle of an interval, by 256 rings.
double mean_sine(const rectified_interval<float>& polar)
{
    double squares = 0, sum = 0;
    for (int i = 0; i < 256; ++i) {
        const double sine =
            std::sin(double(polar.least) + (double(polar.most) - double(polar.least)) * (i + 0.5) / 256);
        squares += sine * sine;
        sum += sine;
    }
    return squares / sum;
}

} // namespace

TEST_CASE("every view ray lies within the guard band of the depth of the rows that it reads")
{
    bit_source bits(1);
    for (int i = 0; i < effort(400); ++i) {
        const rows_of_camera of(any_far_plane<float>(bits),
                                bits.chance(0.5) ? rectified_depth::polar : rectified_depth::cosine);
        for (int k = 0; k < 40; ++k) {
            const auto s = float(bits.uniform(0, 1)), t = float(bits.uniform(0, 1));
            const auto at = [&](float rectified_corner<float>::*m) {
                return (1 - s) * ((1 - t) * of.corners.a.*m + t * of.corners.d.*m) +
                       s * ((1 - t) * of.corners.b.*m + t * of.corners.c.*m);
            };
            const auto p = rectified_from_position(at(&rectified_corner<float>::x), at(&rectified_corner<float>::y),
                                                   at(&rectified_corner<float>::z));
            if (!(p.radius > 1e-3f * of.bounds.radius)) continue; // the axis has no azimuth
            CHECK(std::abs(rectified_depth_at(of.frame, of.rows, p)) <= 1 / 1.1 + 0.02);
        }
    }
}

TEST_CASE("a texel of a row has the optical depth of the mean sine of its rays, within 2% over up to 90 degrees")
{
    bit_source bits(2);
    int with_axis = 0;
    for (int i = 0; i < effort(400); ++i) {
        const rows_of_camera of(any_far_plane<float>(bits), rectified_depth::polar);
        const float step = of.frame.azimuth_length / float(of.rows.size());
        for (std::size_t v = 0; v < of.rows.size(); ++v) {
            const float middle = of.frame.azimuth_start + (float(v) + 0.5f) * step;
            const rectified_interval<float> polar = rectified_row_polar(of.corners, middle - step, middle + step);
            if (polar.most - polar.least > 1.5708f || !(mean_sine(polar) > 1e-3)) continue;
            const double expected =
                double(extinction) * double(rectified_radius_step(of.frame, columns)) / mean_sine(polar);
            // Simpson's rule is off by at most 1.61%.
            CHECK(double(of.rows[v].optical_depth) == doctest::Approx(expected).epsilon(0.02));
            CHECK(double(of.rows[v].factor) == doctest::Approx(std::exp(-double(of.rows[v].optical_depth))));
            with_axis += of.frame.wraps();
        }
    }
    CHECK((with_axis > 0 || draws_few()));
}
