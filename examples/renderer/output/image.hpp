// Pictures: width x height values, rows from top to bottom; magnified insets, signed error colours, compositions, and
// PNG files.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace gnomon::renderer {

template <class T> struct image {
    int width = 0, height = 0;
    std::vector<T> pixels;

    image() = default;
    image(int columns, int rows, const T& value = T())
        : width(columns),
          height(rows),
          pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value)
    {}

    T& operator()(int x, int y) { return pixels[index(x, y)]; }
    const T& operator()(int x, int y) const { return pixels[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

// Linear RGB; 1 is white.
using picture = image<glm::vec3>;

// The mean of each block of factor x factor pixels.
template <class T> image<T> reduced(const image<T>& source, int factor)
{
    image<T> result(source.width / factor, source.height / factor);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            T sum(0);
            for (int j = 0; j < factor; ++j)
                for (int i = 0; i < factor; ++i) sum += source(x * factor + i, y * factor + j);
            result(x, y) = sum / static_cast<float>(factor * factor);
        }
    return result;
}

// Pixels x <= column < x + width, y <= row < y + height.
struct rectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

// The rectangle of this size around (x, y), moved inside width x height where it sticks out.
rectangle rectangle_around(double x, double y, int size, int width, int height);

// The crop, each of its pixels as a block of factor x factor pixels.
picture magnify(const picture& source, const rectangle& crop, int factor);

// Copies source into target with its upper left corner at (x, y); what lies outside of target is left out.
void paste(picture& target, const picture& source, int x, int y);

// The outline of the rectangle, `thickness` pixels wide, just outside of it.
void outline(picture& target, const rectangle& frame, const glm::vec3& colour, int thickness = 2);

// All pictures in one row from left to right, upper edges aligned, `gap` white pixels between them.
picture side_by_side(std::span<const picture> pictures, int gap = 4);

// All pictures in one column from top to bottom, left edges aligned, `gap` white pixels between them.
picture stacked(std::span<const picture> pictures, int gap = 4);

// Diverging map of a signed error of a visibility: white 0, blue for light leaking (too bright), red for acne (too
// dark), saturated at +-scale. NaN is magenta, which no error maps to.
glm::vec3 error_colour(float error, float scale);

// error_colour of estimate - reference.
picture error_picture(const image<float>& estimate, const image<float>& reference, float scale);

picture grey(const image<float>& values);

// The 8-bit sRGB code of a linear value, clamped to [0, 1]; NaN gives 0.
unsigned char srgb8(float linear);

// Writes an 8-bit sRGB PNG aside and renames it, so that a failure leaves an earlier file as it was.
void write_png(const std::filesystem::path& file, const picture& linear);

} // namespace gnomon::renderer
