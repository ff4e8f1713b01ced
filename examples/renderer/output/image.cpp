#include "image.hpp"

#include <fmt/format.h>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "file.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gnomon::renderer {

rectangle rectangle_around(double x, double y, int size, int width, int height)
{
    const auto first = [size](double centre, int extent) {
        return std::clamp(static_cast<int>(std::lround(centre - 0.5 * size)), 0, std::max(extent - size, 0));
    };
    return {first(x, width), first(y, height), std::min(size, width), std::min(size, height)};
}

picture magnify(const picture& source, const rectangle& crop, int factor)
{
    picture result(crop.width * factor, crop.height * factor);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) result(x, y) = source(crop.x + x / factor, crop.y + y / factor);
    return result;
}

void paste(picture& target, const picture& source, int x, int y)
{
    for (int row = std::max(0, -y); row < std::min(source.height, target.height - y); ++row)
        for (int column = std::max(0, -x); column < std::min(source.width, target.width - x); ++column)
            target(x + column, y + row) = source(column, row);
}

void outline(picture& target, const rectangle& frame, const glm::vec3& colour, int thickness)
{
    const picture across(frame.width + 2 * thickness, thickness, colour), down(thickness, frame.height, colour);
    paste(target, across, frame.x - thickness, frame.y - thickness);
    paste(target, across, frame.x - thickness, frame.y + frame.height);
    paste(target, down, frame.x - thickness, frame.y);
    paste(target, down, frame.x + frame.width, frame.y);
}

picture side_by_side(std::span<const picture> pictures, int gap)
{
    int width = -gap, height = 0;
    for (const picture& part : pictures) width += part.width + gap, height = std::max(height, part.height);
    picture result(std::max(width, 0), height, glm::vec3(1));
    int x = 0;
    for (const picture& part : pictures) paste(result, part, x, 0), x += part.width + gap;
    return result;
}

picture stacked(std::span<const picture> pictures, int gap)
{
    int width = 0, height = -gap;
    for (const picture& part : pictures) width = std::max(width, part.width), height += part.height + gap;
    picture result(width, std::max(height, 0), glm::vec3(1));
    int y = 0;
    for (const picture& part : pictures) paste(result, part, 0, y), y += part.height + gap;
    return result;
}

glm::vec3 error_colour(float error, float scale)
{
    if (std::isnan(error)) return {1, 0, 1};
    const glm::vec3 leak(0.02f, 0.12f, 0.6f), acne(0.6f, 0.02f, 0.03f);
    return glm::mix(glm::vec3(1), error > 0 ? leak : acne, std::min(std::abs(error) / scale, 1.f));
}

picture error_picture(const image<float>& estimate, const image<float>& reference, float scale)
{
    if (estimate.width != reference.width || estimate.height != reference.height)
        throw std::invalid_argument(fmt::format("error_picture: estimate is {}x{}, reference is {}x{}", estimate.width,
                                                estimate.height, reference.width, reference.height));
    picture result(estimate.width, estimate.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = error_colour(estimate.pixels[i] - reference.pixels[i], scale);
    return result;
}

picture grey(const image<float>& values)
{
    picture result(values.width, values.height);
    std::ranges::transform(values.pixels, result.pixels.begin(), [](float value) { return glm::vec3(value); });
    return result;
}

unsigned char srgb8(float linear)
{
    const float l = linear > 0 ? std::min(linear, 1.f) : 0.f;
    const float encoded = l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1 / 2.4f) - 0.055f; // IEC 61966-2-1
    return static_cast<unsigned char>(std::lround(255 * encoded));
}

void write_png(const std::filesystem::path& file, const picture& linear)
{
    std::string codes, png;
    codes.reserve(3 * linear.pixels.size());
    for (const glm::vec3& pixel : linear.pixels)
        for (int channel = 0; channel < 3; ++channel) codes.push_back(static_cast<char>(srgb8(pixel[channel])));
    const auto append = [](void* text, void* bytes, int count) {
        static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
    };
    if (!stbi_write_png_to_func(append, &png, linear.width, linear.height, 3, codes.data(), 3 * linear.width))
        throw std::runtime_error(
            fmt::format("{}: {}x{} pixels cannot be a PNG", file.string(), linear.width, linear.height));
    write_file(file, png);
}

} // namespace gnomon::renderer
