// What the default bias of six moments costs and what it is worth, over all families, with receivers anywhere:
//     leak    mean max(0, ideal bound - result), where the ideal bound is sharp for the distribution itself;
//     jitter  mean |result - the same kernel in double on exact moments|, what rounding in storage and kernel moves.
#include "support/distributions.hpp"
#include "support/effort.hpp"
#include "support/oracle.hpp"
#include "support/statistics.hpp"

#include <gnomon/storage/moments_formats.hpp>

#include <doctest/doctest.h>

#include <cstdio>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> moments6<T> rounded(const high_moments<6>& b)
{
    return {T(b[1]), T(b[2]), T(b[3]), T(b[4]), T(b[5]), T(b[6])};
}

/// What filtering in the precision of the map leaves: single depths' moments, rounded, combined in float.
moments6<float> filtered(const distribution& d)
{
    moments6<float> sum{};
    for (std::size_t i = 0; i < d.depths.size(); ++i)
        sum = moments6_add(sum, moments6_from_depth(float(d.depths[i])), float(d.weights[i]));
    return sum;
}

template <class T> double lower(const hankel6<T>& h, double z_f) { return double(hamburger6_lower(h, T(z_f))); }

moments6<double> channels(const moments6_unorm10&, moments6<double> b) { return theta6(b); }
moments6<double> channels(const moments6_unorm16&, moments6<double> b) { return theta6(b); }
moments6<double> channels(const moments6_float&, moments6<double> b) { return b; }

struct scores {
    double leak = 0, jitter = 0;
};

struct sample {
    distribution d;
    high_moments<6> b;
    double z_f, ideal;
};

const std::vector<sample>& samples()
{
    static const std::vector<sample> all = [] {
        std::vector<sample> list;
        distribution_source source(5);
        for (int f = 0; f < family_count; ++f)
            for (std::int64_t i = 0; i < effort(1500); ++i) {
                distribution d = source.draw(family(f));
                const double z_f = double(float(source.uniform(-1, 1)));
                const double ideal = ideal_lower<6>(d, z_f);
                list.push_back({std::move(d), {}, z_f, ideal});
                list.back().b = exact_moments<6>(list.back().d);
            }
        return list;
    }();
    return all;
}

/// Scores of one bias: factor maps channels, in float and in double, to a factored matrix.
template <class Format, class Factor> scores score(Format format, bool filter, Factor factor)
{
    scores r;
    for (const auto& s : samples()) {
        const auto moments = filter ? filtered(s.d) : rounded<float>(s.b);
        const double result = lower(factor(Format::decode(Format::encode(moments))), s.z_f);
        const double exact = lower(factor(channels(format, rounded<double>(s.b))), s.z_f);
        r.leak += std::max(0.0, s.ideal - result);
        r.jitter += std::abs(result - exact);
    }
    const double n = double(samples().size());
    return {r.leak / n, r.jitter / n};
}

/// Prints the row of one format and returns the default's leak and jitter relative to the paper's.
template <class Format, class Paper> scores compare(Format format, bool filter, Paper paper)
{
    const scores ours = score<Format>(format, filter, [](auto c) { return Format::factor(c); });
    const scores theirs = score<Format>(format, filter, paper);
    std::printf("%-11s%-10s leak %.3e, paper %.3e, %+.0f%%   jitter %.2e, paper %.2e, %+.0f%%\n",
                std::string(Format::name).c_str(), filter ? ", filtered" : "", ours.leak, theirs.leak,
                100 * (ours.leak / theirs.leak - 1), ours.jitter, theirs.jitter,
                100 * (ours.jitter / theirs.jitter - 1));
    return {ours.leak / theirs.leak, ours.jitter / theirs.jitter};
}

const auto paper6_float = [](auto b) {
    using T = decltype(b.b1);
    return hankel6_constant_bias(b, T(bias6_paper_b2), T(bias6_paper_b4), T(bias6_paper_b6), T(5e-6));
};

} // namespace

// The same weight, and a vector b* that is farther from the boundary: less leaks, and no pivot falls below what a
// rounding makes of it. The paper's vector keeps the middle of the range a little calmer.
TEST_CASE("six floats leak 10% less than with the paper's bias, and are at most 15% more sensitive")
{
    for (const bool filter : {false, true}) {
        const scores ratio = compare<moments6_float>({}, filter, paper6_float);
        CHECK(ratio.leak <= 0.9);
        CHECK(ratio.jitter <= 1.15);
    }
}

TEST_CASE("shorter formats leak no more than with the paper's bias")
{
    const auto paper = [](double weight) {
        return [=](auto c) {
            using T = decltype(c.b1);
            return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), T(bias6_paper_b2), T(bias6_paper_b4),
                                                          T(bias6_paper_b6), T(weight)));
        };
    };
    CHECK(compare<moments6_unorm16>({}, false, paper(8e-5)).leak <= 1.02);
    CHECK(compare<moments6_unorm10>({}, false, paper(4e-3)).leak <= 1.02);
}
