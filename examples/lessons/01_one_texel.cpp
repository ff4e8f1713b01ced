// What does one texel of a moment shadow map know about the depths that were filtered into it?
//
// A texel holds the means of z, z^2, z^3 and z^4 over all depths z of its filter region: four numbers, however many
// depths there are. For any receiver they bound the share of these depths that lies in front of it. The lower bound is
// the shadow intensity: it never darkens a lit surface.
#include <gnomon/storage/formats.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

using format = gnomon::moments4_unorm16; // 64 bits per texel, as in a texture of four 16-bit UNORM channels

// A filter region over a post and the ground behind it. Depths are signed: -1 is the near plane, 1 the far plane.
constexpr std::array depths{-0.52f, -0.50f, -0.48f, 0.28f, 0.29f, 0.30f, 0.31f, 0.32f};

// The exact answer: the share of all depths in front of the receiver. A filter cannot know it without every depth.
float exact_intensity(float receiver)
{
    const auto in_front = std::ranges::count_if(depths, [=](float z) { return z < receiver; });
    return float(in_front) / float(depths.size());
}

int main()
{
    // Filtering is a weighted sum of moments: a blur, a mip level, the resolve of many samples or a texture unit.
    const float weight = 1 / float(depths.size());
    gnomon::moments4<float> mean{}; // the means of z, z^2, z^3, z^4
    for (const float z : depths) mean = gnomon::moments4_add(mean, gnomon::moments4_from_depth(z), weight);

    // The format turns moments into a texel, by a transform that keeps as much precision as 64 bits can.
    const format::texel texel = format::encode(format::from_moments(mean));
    std::printf("%zu depths in one texel: %u %u %u %u\n\n", depths.size(), texel[0], texel[1], texel[2], texel[3]);

    // A look-up decodes the texel, as a texture unit would, and asks for the intensity at the receiver's depth.
    std::printf("receiver  exact  from the texel\n");
    for (int step = -18; step <= 18; ++step) {
        const float receiver = float(step) / 20;
        const float intensity = format::intensity(format::decode(texel), receiver); // 0 is lit, 1 is in shadow
        std::printf("%8.2f  %5.3f  %14.3f\n", double(receiver), double(exact_intensity(receiver)), double(intensity));
    }
}
