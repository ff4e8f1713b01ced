// Half floats on a device that stores the half next towards zero, as Direct3D allows.
#pragma once

#include <gnomon/storage/moments4.hpp>

#include <array>
#include <bit>
#include <cmath>

namespace gnomon::test {

struct truncated_half : moments4_half {
    static texel encode(const channels4<float>& c)
    {
        const auto numbers = std::bit_cast<std::array<float, 4>>(c);
        texel t = moments4_half::encode(c);
        for (std::size_t k = 0; k < 4; ++k)
            if (std::abs(half_decode(t[k])) > std::abs(numbers[k])) --t[k];
        return t;
    }
};

} // namespace gnomon::test
