// How does the depth buffer of an engine become the signed depth that moments want?
//
// Moments want depth that is linear in the distance from the light, from -1 at the near plane to 1 at the far plane:
// then every step of distance has the same precision, and surfaces keep the ratios of their distances. An orthographic
// light's buffer is linear already; that of a perspective light (a spot light, a cube face) is not, and has to be
// undone first.
#include <gnomon/moments/moments.h>

#include <array>
#include <cstdio>

using gnomon::depth_from_distance;

constexpr float near_plane = 0.5f, far_plane = 40; // of the light, in metres

// What four kinds of depth buffers hold at this distance. Vulkan, Direct3D and Metal clear them to the far plane.
float linear_buffer(float d) { return (d - near_plane) / (far_plane - near_plane); }                        // 0 to 1
float reversed_linear_buffer(float d) { return (far_plane - d) / (far_plane - near_plane); }                // 1 to 0
float perspective_buffer(float d) { return far_plane * (d - near_plane) / (d * (far_plane - near_plane)); } // 0 to 1
float infinite_buffer(float d) { return near_plane / d; } // 1 to 0, reversed, its far plane infinitely far away

int main()
{
    std::printf("distance  depth | linear  reversed  perspective  infinite | perspective taken for linear\n");
    for (const float d : {0.5f, 1.0f, 2.0f, 5.0f, 10.0f, 20.0f, 40.0f}) {
        const float z = perspective_buffer(d), reversed_infinite = infinite_buffer(d);
        const float perspective_distance = near_plane * far_plane / (far_plane - z * (far_plane - near_plane));
        const float infinite_distance = near_plane / reversed_infinite;
        std::printf("%8.1f  %5.2f | %6.2f  %8.2f  %11.2f  %8.2f | %5.2f\n", double(d),
                    double(depth_from_distance(d, near_plane, far_plane)),
                    double(gnomon::depth_from_unit(linear_buffer(d))),
                    double(gnomon::depth_from_reversed(reversed_linear_buffer(d))),
                    double(depth_from_distance(perspective_distance, near_plane, far_plane)),
                    double(depth_from_distance(infinite_distance, near_plane, far_plane)),
                    double(gnomon::depth_from_unit(z))); // wrong: nearly everything is close to 1
    }

    // Cascades: each has planes of its own, and so the whole precision of its texels between them.
    constexpr std::array planes{0.5f, 3.0f, 12.0f, 40.0f};
    std::printf("\ndistance  cascade  its depth\n");
    for (const float d : {0.5f, 2.0f, 3.5f, 10.0f, 15.0f, 39.0f}) {
        std::size_t cascade = 0;
        while (d > planes[cascade + 1]) ++cascade;
        std::printf("%8.1f  %7zu  %9.2f\n", double(d), cascade,
                    double(depth_from_distance(d, planes[cascade], planes[cascade + 1])));
    }
}
