// Hostile inputs for kernels: a third any bit patterns, a third special numbers, a third moments of few depths with
// small or large errors.
#pragma once

#include <gnomon/portable.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace gnomon::test {

/// A source of random bits: SplitMix64 (Steele, Lea & Flood 2014).
class bit_source {
  public:
    explicit bit_source(std::uint64_t seed) : state_(seed) {}
    std::uint64_t operator()()
    {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::size_t below(std::size_t n) { return std::size_t(((*this)() >> 32) * n >> 32); }
    double uniform(double a, double b) { return a + (b - a) * double((*this)() >> 11) * 0x1p-53; }
    bool chance(double p) { return uniform(0, 1) < p; }

  private:
    std::uint64_t state_;
};

template <class T> class hostile_source {
  public:
    explicit hostile_source(std::uint64_t seed) : bits_(seed) {}

    /// The next six moments or channels, and a receiver.
    std::array<T, 7> draw()
    {
        std::array<T, 7> x{};
        switch (bits_.below(3)) {
            case 0:
                for (T& v : x) v = pattern();
                break;
            case 1:
                for (T& v : x) v = special();
                break;
            default:
                x = nearly_moments();
        }
        return x;
    }

    T pattern()
    {
        using word = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        return gnomon_bit_cast<T>(word(bits_() >> (64 - 8 * sizeof(T))));
    }

    T special()
    {
        using limits = std::numeric_limits<T>;
        constexpr std::array<T, 16> numbers{0,
                                            1,
                                            T(0.5),
                                            T(0.375),
                                            2,
                                            limits::epsilon(),
                                            1 - limits::epsilon() / 2,
                                            1 + limits::epsilon(),
                                            limits::min(),
                                            limits::denorm_min(),
                                            limits::max(),
                                            limits::infinity(),
                                            limits::quiet_NaN(),
                                            T(1e-20),
                                            T(1e18),
                                            T(1e-3)};
        const T x = numbers[bits_.below(numbers.size())];
        return bits_.chance(0.5) ? -x : x;
    }

  private:
    /// Moments of one to four depths, some at the ends, rounded to T and then often perturbed, swapped or partly
    /// replaced. The receiver is at one of the depths half of the time.
    std::array<T, 7> nearly_moments()
    {
        std::array<double, 4> depths{}, weights{};
        const std::size_t count = 1 + bits_.below(4);
        double total = 0;
        for (std::size_t i = 0; i < count; ++i) {
            depths[i] = bits_.chance(0.2) ? (bits_.chance(0.5) ? 1 : -1) : bits_.uniform(-1, 1);
            if (i > 0 && bits_.chance(0.2)) depths[i] = depths[0] * (1 - bits_.uniform(0, 1e-3));
            total += weights[i] = bits_.chance(0.1) ? 1e-7 : bits_.uniform(0.01, 1);
        }
        std::array<T, 7> x{};
        for (std::size_t j = 0; j < 6; ++j) {
            double b = 0;
            for (std::size_t i = 0; i < count; ++i) {
                weights[i] *= depths[i];
                b += weights[i] / total;
            }
            x[j] = T(b);
        }
        x[6] = bits_.chance(0.5) ? T(depths[bits_.below(count)]) : T(bits_.uniform(-1, 1));
        switch (bits_.below(6)) {
            case 0: {
                const double noise = std::ldexp(1.0, -int(bits_.below(30)));
                for (std::size_t j = 0; j < 6; ++j) x[j] += T(noise * bits_.uniform(-1, 1));
                break;
            }
            case 1:
                x[bits_.below(7)] = special();
                break;
            case 2:
                x[bits_.below(7)] = pattern();
                break;
            case 3:
                std::swap(x[0], x[1]);
                break;
            case 4: {
                const T cleared = special(); // a map that is cleared and not drawn
                for (std::size_t j = 0; j < 6; ++j) x[j] = cleared;
                break;
            }
            default:
                break;
        }
        return x;
    }

    bit_source bits_;
};

} // namespace gnomon::test
