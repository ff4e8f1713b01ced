// The elementary functions. The baseline of each is the function of the C library in scalar code.
#include "core/uniform.hpp"

#include <gnomon/numerics/exp.h>
#include <gnomon/numerics/trigonometry.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

struct exp_range : uniform<1> {
    static auto samples(std::size_t count, std::uint64_t seed) { return uniform::samples(count, seed, -80, 80); }
};
struct log_range : uniform<1> {
    static auto samples(std::size_t count, std::uint64_t seed) { return uniform::samples(count, seed, 1e-6, 1e6); }
};
struct angle_range : uniform<1> {
    static auto samples(std::size_t count, std::uint64_t seed) { return uniform::samples(count, seed, -100, 100); }
};
struct plane_range : uniform<2> {
    static auto samples(std::size_t count, std::uint64_t seed) { return uniform::samples(count, seed, -1, 1); }
};

struct library_exp : exp_range {
    template <class Real> static Real run(Real x) { return std::exp(x); }
};
struct library_log : log_range {
    template <class Real> static Real run(Real x) { return std::log(x); }
};
struct library_cos_sin : angle_range {
    template <class Real> static Real run(Real x) { return std::cos(x) + std::sin(x); }
};
struct library_atan2 : plane_range {
    template <class Real> static Real run(Real y, Real x) { return std::atan2(y, x); }
};

struct exp : exp_range {
    static constexpr auto name = "exp";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real x) { return polynomial_exp(x); }
};
struct log : log_range {
    static constexpr auto name = "log";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real x) { return polynomial_log(x); }
};
struct cos_sin : angle_range {
    static constexpr auto name = "cos and sin";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real x)
    {
        const cosine_sine<Real> r = polynomial_cosine_sine(x);
        return r.cosine + r.sine;
    }
};
struct atan2 : plane_range {
    static constexpr auto name = "atan2";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real y, Real x) { return polynomial_atan2(y, x); }
};

[[maybe_unused]] const bool registered = [] {
    add_rows<exp, library_exp>("elementary");
    add_rows<log, library_log>("elementary");
    add_rows<cos_sin, library_cos_sin>("elementary");
    add_rows<atan2, library_atan2>("elementary");
    return true;
}();

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
