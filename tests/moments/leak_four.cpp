// Leak and darkness of four moments by every route to an intensity: the table of docs/decisions/2-bias.md. Leak is the
// mean of max(0, ideal bound - result), where the ideal bound is sharp for the distribution itself. Darkness is the
// largest result - Z(z < z_f). All families, one rounding in storage, and receivers
//     of the family   anywhere, on a depth or near one (distributions.hpp)
//     on a depth      the commonest lit receiver
//     anywhere        in [-1, 1]
#include "evaluation/methods/raised_pivots4.hpp"
#include "support/distributions.hpp"
#include "support/documented.hpp"
#include "support/effort.hpp"
#include "support/honest_limit.hpp"
#include "support/oracle.hpp"

#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <cstdio>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using moments = moments4<float>;
using channels = channels4<float>;

/// A format: half a code of each channel, b* and r of bias.h, and the vector and weight of the paper, which has no
/// weight for half floats.
struct storage {
    const char* name;
    double delta, bias, distance, paper_bias, paper_weight;
};
constexpr storage storage_of(const moments4_unorm16&)
{
    return {"4 x 16 UNORM", 1.0 / 131070, bias4_theta_b2, 0.21652, bias4_theta_paper_b2, 6e-5};
}
constexpr storage storage_of(const moments4_half&)
{
    return {"4 x half", 0x1p-13, bias4_theta_b2, 0.21652, bias4_theta_paper_b2, 9e-4};
}
constexpr storage storage_of(const moments4_float&)
{
    return {"4 x float", 0x1p-25, bias4_raw_b2, 0.10147, bias4_raw_paper_b2, 3e-7};
}

/// The largest change of E[p] by errors of half a code.
double theta_norm(double delta, const quartic& p)
{
    const double odd = p[1] + 0.75 * p[3];
    return delta * (std::abs(p[1] / 3 + 0.75 * p[3]) + std::sqrt(3.0) * std::abs(odd) + std::abs(p[2] - p[4]) / 8 +
                    std::abs(p[2] + p[4]));
}
double norm_of(const moments4_float& f, const quartic& p)
{
    return storage_of(f).delta * (std::abs(p[1]) + std::abs(p[2]) + std::abs(p[3]) + std::abs(p[4]));
}
template <class Format> double norm_of(const Format& f, const quartic& p) { return theta_norm(storage_of(f).delta, p); }

moments raw(const moments4_unorm16&, const channels& c) { return theta4_inverse(c); }
moments raw(const moments4_half&, const channels& c) { return theta4_inverse(channels4_shifted(c, 0.5f)); }
moments raw(const moments4_float&, const channels& c) { return moments4_from_channels(c); }

enum route { limit, certified, constant, paper, raised_pivots };
constexpr std::size_t routes = 5;

template <class Format> double shown(route w, const Format& f, const channels& c, double z_f)
{
    const storage s = storage_of(f);
    const float z = float(z_f);
    switch (w) {
        case limit: {
            const moments b = raw(f, c);
            return honest_limit({double(b.b1), double(b.b2), double(b.b3), double(b.b4)}, z_f, s.bias,
                                s.delta / s.distance, [&](const quartic& p) { return norm_of(f, p); });
        }
        case certified:
            return double(Format::intensity(c, z));
        case constant:
            return double(hamburger4_lower(Format::factor(c), z));
        case paper:
            return double(hamburger4_lower(
                hankel4_constant_bias(raw(f, c), float(s.paper_bias), float(s.paper_bias), float(s.paper_weight)), z));
        case raised_pivots:
            return double(hamburger4_lower(bench::hankel4_raised_from(f, c), z));
    }
    return 0;
}

struct view {
    distribution d;
    double z_f, ideal;
};
constexpr std::array<const char*, 3> receivers = {"of the family", "on a depth", "anywhere"};

/// The views for each kind of receiver.
const std::array<std::vector<view>, 3>& views()
{
    static const std::array<std::vector<view>, 3> all = [] {
        std::array<std::vector<view>, 3> lists;
        distribution_source source(5);
        for (int f = 0; f < family_count; ++f)
            for (std::int64_t i = 0; i < std::clamp<std::int64_t>(effort(300), 60, 300); ++i) {
                const distribution d = source.draw(family(f));
                const double on = d.depths[std::size_t(source.uniform(0, double(d.depths.size()) * 0.9999999))];
                const std::array<double, 3> z_f = {source.receiver(d), on, source.uniform(-1, 1)};
                for (std::size_t k = 0; k < 3; ++k) {
                    const double z = double(float(z_f[k]));
                    lists[k].push_back({d, z, ideal_lower<4>(d, z)});
                }
            }
        return lists;
    }();
    return all;
}

struct scores {
    std::array<double, routes> leak{}, darkness{};
};

template <class Format> scores score(const Format& f, const std::vector<view>& list)
{
    scores r;
    for (const view& v : list) {
        const auto b = exact_moments<4>(v.d);
        const moments exact{float(b[1]), float(b[2]), float(b[3]), float(b[4])};
        const channels c = Format::decode(Format::encode(Format::from_moments(exact)));
        for (std::size_t w = 0; w < routes; ++w) {
            const double result = shown(route(w), f, c, v.z_f);
            r.leak[w] += std::max(0.0, v.ideal - result) / double(list.size());
            r.darkness[w] = std::max(r.darkness[w], result - v.d.below(v.z_f));
        }
    }
    return r;
}

} // namespace

TEST_CASE_TEMPLATE(
    "certificates leak at most 10% more than the honest limit, less than a constant bias, and darken nothing", Format,
    moments4_unorm16, moments4_half, moments4_float)
{
    const Format f;
    for (std::size_t k = 0; k < 3; ++k) {
        const scores s = score(f, views()[k]);
        std::printf("| %s | %s |", storage_of(f).name, receivers[k]);
        for (const double x : s.leak) std::printf(" %.2e |", x);
        std::printf(" %.1e |\n", std::max(s.darkness[raised_pivots], 0.0));
        CHECK(s.leak[certified] <= 1.1 * s.leak[limit]);
        CHECK(s.leak[certified] < s.leak[constant]);
        CHECK(s.darkness[limit] <= 1e-12);
        CHECK(s.darkness[certified] <= Format::darkening);
        CHECK(s.darkness[constant] <= Format::bias_weight + stored4_arithmetic_weight);
        if (effort(300) < 300) continue;
        const std::vector<double> stated =
            documented("docs/decisions/2-bias.md", std::string(storage_of(f).name) + " | " + receivers[k]);
        CHECK(stated.size() == routes + 1);
        if (stated.size() != routes + 1) continue;
        for (std::size_t w = 0; w < routes; ++w) CHECK(stated[w] == doctest::Approx(s.leak[w]).epsilon(0.02));
        CHECK(stated[routes] == doctest::Approx(std::max(s.darkness[raised_pivots], 0.0)).epsilon(0.06));
    }
}
