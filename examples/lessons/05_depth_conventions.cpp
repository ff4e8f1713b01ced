// How does the depth buffer of an engine become the signed depth that moments want?
//
// Moments want depth that is linear in the distance from the light, from -1 at the near plane to 1 at the far plane:
// then every step of distance has the same precision, and filters average distances. The buffer of an orthographic
// light is linear. That of a perspective light (a spot light, a cube face) is not: there is a kernel for each
// convention.
#include <gnomon/moments/depth.h>

#include <array>
#include <cstdio>

constexpr float near_plane = 0.5f, far_plane = 40, length = far_plane - near_plane; // of the light, in metres

// The value in each kind of buffer at a distance. Engines reverse buffers, so that floats are precise at the far plane.
float linear_buffer(float d) { return (d - near_plane) / length; }                        // 0 near, 1 far
float reversed_linear_buffer(float d) { return (far_plane - d) / length; }                // 1 near, 0 far
float perspective_buffer(float d) { return far_plane * (d - near_plane) / (d * length); } // 0 near, 1 far
float reversed_buffer(float d) { return near_plane * (far_plane - d) / (d * length); }    // 1 near, 0 far
float infinite_buffer(float d) { return near_plane / d; }                                 // 1 near, 0 at infinity

int main()
{
    std::printf("          signed depth from             perspective buffers                 perspective\n");
    std::printf("distance  distance  linear  reversed  | plain  reversed  infinite  | taken for linear\n");
    for (const float d : {0.5f, 1.0f, 2.0f, 5.0f, 10.0f, 20.0f, 40.0f}) {
        const float z = perspective_buffer(d);
        std::printf("%8.1f  %8.2f  %6.2f  %8.2f  | %5.2f  %8.2f  %8.2f  | %16.2f\n", double(d),
                    double(gnomon::depth_from_distance(d, near_plane, far_plane)),
                    double(gnomon::depth_from_unit(linear_buffer(d))),
                    double(gnomon::depth_from_reversed(reversed_linear_buffer(d))),
                    double(gnomon::depth_from_perspective(z, near_plane, far_plane)),
                    double(gnomon::depth_from_reversed_perspective(reversed_buffer(d), near_plane, far_plane)),
                    double(gnomon::depth_from_reversed_infinite(infinite_buffer(d), near_plane, far_plane)),
                    double(gnomon::depth_from_unit(z))); // wrong: nearly everything is close to the far plane
    }

    // Cascades: each has planes of its own, and so all the precision of its texels between them.
    constexpr std::array planes{0.5f, 3.0f, 12.0f, 40.0f};
    std::printf("\ndistance  cascade  its depth\n");
    for (const float d : {0.5f, 2.0f, 3.5f, 10.0f, 15.0f, 39.0f}) {
        std::size_t cascade = 0;
        while (d > planes[cascade + 1]) ++cascade;
        std::printf("%8.1f  %7zu  %9.2f\n", double(d), cascade,
                    double(gnomon::depth_from_distance(d, planes[cascade], planes[cascade + 1])));
    }
}
