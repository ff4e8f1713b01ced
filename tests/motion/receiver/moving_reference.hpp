// Moving triangles in extended precision, and scenes to compare them in.
#pragma once

#include "motion/triangle/coverage_check.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::test {

/// A triangle in extended precision, and the error that edge functions of the kernels may have.
template <class T> class reference {
  public:
    reference(const moving_triangle<T>& m, T s_x, T s_y)
    {
        const std::array<moving_vertex<T>, 3> v{m.a, m.b, m.c};
        for (std::size_t k = 0; k < 3; ++k) {
            open_[k] = {exact(v[k].x0), exact(v[k].y0), exact(v[k].z0), exact(v[k].w0)};
            close_[k] = {exact(v[k].x1), exact(v[k].y1), exact(v[k].z1), exact(v[k].w1)};
            for (auto* p : {&open_[k], &close_[k]}) {
                size_x_[k] = std::max(size_x_[k], std::abs((*p)[0]) + std::abs(exact(s_x) * (*p)[3]));
                size_y_[k] = std::max(size_y_[k], std::abs((*p)[1]) + std::abs(exact(s_y) * (*p)[3]));
                (*p)[0] -= exact(s_x) * (*p)[3];
                (*p)[1] -= exact(s_y) * (*p)[3];
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            tolerance[k] = 32 * exact(u<T>) * (size_x_[i] * size_y_[j] + size_y_[i] * size_x_[j]);
        }
    }

    struct moment {
        std::array<exact, 3> edges, z, w;
    };
    moment at(exact t) const
    {
        std::array<std::array<exact, 4>, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 4; ++i) p[k][i] = (1 - t) * open_[k][i] + t * close_[k][i];
        moment r;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
            r.edges[k] = a[0] * b[1] - a[1] * b[0];
            r.z[k] = p[k][2];
            r.w[k] = p[k][3];
        }
        return r;
    }

    std::array<exact, 3> tolerance{};

  private:
    std::array<std::array<exact, 4>, 3> open_, close_;
    std::array<exact, 3> size_x_{}, size_y_{};
};

/// Calls f(triangle, s_x, s_y, movement) as T.
template <class T, class F> void for_each_scene(std::int64_t scenes, std::uint64_t seed, F f)
{
    bit_source bits(seed);
    for (std::int64_t i = 0; i < effort(scenes); ++i) {
        const auto how = movement(std::size_t(i) % movement_count);
        const moving_scene scene = draw_moving_scene(how, bits);
        f(rounded_triangle<T>(scene.triangle), T(scene.s_x), T(scene.s_y), how);
    }
}

} // namespace gnomon::test
