// The edges of the regions in which methods fail, held where they are. tests/evaluation/sweeps.txt has a line for each
// layer of each sweep, SWEEP LAYER ROW..., a row for each value of y: runs of points that pass (.) and fail (#) along x,
// such as .20#12. With GNOMON_WRITE_SWEEPS=1 the test writes the file anew.
#include "evaluation/atlas/fog.hpp"
#include "evaluation/atlas/rectangles.hpp"
#include "evaluation/atlas/region.hpp"
#include "evaluation/atlas/sweep.hpp"
#include "support/documented.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon::evaluation;

namespace {

using picture = std::vector<std::string>; // of '.' and '#'

picture failures(const sweep& s, const sweep_layer& l)
{
    picture result;
    for (const std::vector<double>& row : errors_of(s, l)) {
        std::string& marks = result.emplace_back();
        for (const double error : row) marks += error <= s.threshold ? '.' : '#'; // NaN fails
    }
    return result;
}

std::string packed(const picture& p)
{
    std::string result;
    for (const std::string& row : p) {
        result += ' ';
        for (std::size_t i = 0, end = 0; i < row.size(); i = end) {
            end = std::min(row.find_first_not_of(row[i], i), row.size());
            result += row[i] + std::to_string(end - i);
        }
    }
    return result;
}

picture unpacked(std::istream& runs)
{
    picture result;
    for (std::string row; runs >> row;) {
        std::string& marks = result.emplace_back();
        for (std::size_t i = 0; i < row.size();) {
            std::size_t digits = 0;
            marks.append(std::stoul(row.substr(i + 1), &digits), row[i]);
            i += 1 + digits;
        }
    }
    return result;
}

// True where a neighbour along x or y has another mark.
bool at_edge(const picture& p, std::size_t x, std::size_t y)
{
    const char mark = p[y][x];
    return (x > 0 && p[y][x - 1] != mark) || (x + 1 < p[y].size() && p[y][x + 1] != mark) ||
           (y > 0 && p[y - 1][x] != mark) || (y + 1 < p.size() && p[y + 1][x] != mark);
}

const std::filesystem::path kept = GNOMON_SWEEPS;

std::map<std::string, picture> kept_pictures()
{
    std::map<std::string, picture> result;
    std::ifstream file(kept);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name, layer_name;
        words >> name >> layer_name;
        result[name + ' ' + layer_name] = unpacked(words);
    }
    return result;
}

const sweep& named(const char* id) { return registry_of<sweep>().at(id); }

} // namespace

TEST_CASE("every sweep's failing region ends where it is known to end, within a point of the grid")
{
    std::map<std::string, picture> expected = kept_pictures();
    std::ostringstream found_text;
    for (const sweep* s : registry_of<sweep>().all()) {
        for (const sweep_layer& l : s->layers()) {
            const std::string name = s->id + ' ' + l.id;
            const picture found = failures(*s, l);
            found_text << name << packed(found) << '\n';
            const picture old = expected[name];
            expected.erase(name);
            CHECK_MESSAGE(old.size() == found.size(), name, ": not in sweeps.txt, or of another size");
            if (old.size() != found.size()) continue;
            for (std::size_t y = 0; y < found.size(); ++y) {
                REQUIRE(old[y].size() == found[y].size());
                for (std::size_t x = 0; x < found[y].size(); ++x) {
                    INFO(name << " at column " << x << ", row " << y);
                    CHECK((found[y][x] == old[y][x] || (at_edge(old, x, y) && at_edge(found, x, y))));
                }
            }
        }
    }
    for (const auto& [name, unused] : expected) FAIL_CHECK(name << ": in sweeps.txt, and no layer of a sweep");
    if (std::getenv("GNOMON_WRITE_SWEEPS") != nullptr) std::ofstream(kept) << found_text.str();
}

TEST_CASE("docs/stability.md has the share of points at which each method fails, in percent")
{
    std::map<std::string, std::vector<double>> shares;
    for (const sweep* s : registry_of<sweep>().all()) {
        if (s->id == "exponents") continue; // of formats, not of methods
        for (const sweep_layer& l : s->layers()) {
            double failing = 0, points = 0;
            for (const std::string& row : failures(*s, l)) {
                failing += double(std::ranges::count(row, '#'));
                points += double(row.size());
            }
            shares[l.id].push_back(100 * failing / points);
        }
    }
    for (const auto& [id, expected] : shares) {
        if (id == "pcf") continue; // the reference of all sweeps but one
        std::ostringstream row;
        row << "| " << id << " |";
        for (const double share : expected) row << ' ' << std::lround(share) << " |";
        INFO("expected: " << row.str());
        const std::vector<double> told = gnomon::test::documented("docs/stability.md", id);
        CHECK(told.size() == expected.size());
        for (std::size_t i = 0; i < std::min(told.size(), expected.size()); ++i)
            CHECK(std::abs(told[i] - expected[i]) <= 1);
    }
}

TEST_CASE("axes begin and end where they say, evenly or by an even ratio")
{
    CHECK(sweep_axis{"x", "x", scale::linear, 1, 3, 3}.values() == std::vector{1.0, 2.0, 3.0});
    const std::vector<double> ratio = sweep_axis{"x", "x", scale::log, 1e-4, 1, 5}.values();
    CHECK(ratio.front() == 1e-4);
    CHECK(ratio[2] == doctest::Approx(1e-2));
    CHECK(ratio.back() == doctest::Approx(1));
}

TEST_CASE("the exact intensity of a region is the weight in front of the receiver")
{
    const std::array region{layer{-0.5f, 0.25f}, layer{0.f, 0.25f}, layer{0.5f, 0.5f}};
    CHECK(exact_intensity(region, -0.5f) == 0); // a surface does not shadow itself
    CHECK(exact_intensity(region, 0.f) == 0.25);
    CHECK(exact_intensity(region, 1.f) == 1);
    CHECK(exact_blocker(region, -0.5f) == -0.5);
    CHECK(exact_blocker(region, 0.f) == -0.5);
    CHECK(exact_blocker(region, 1.f) == 0.125);
}

TEST_CASE("the exact intensity of fog is what the layers before the receiver take of the light")
{
    const std::array fog{pane{0.5f, 0.5f}, pane{0.f, 0.25f}};
    CHECK(exact_intensity(fog, 0.8f, 0.f) == 0);
    CHECK(exact_intensity(fog, 0.8f, 0.5f) == 0.25);
    CHECK(exact_intensity(fog, 0.8f, 0.8f) == 0.625);
    CHECK(exact_intensity(fog, 0.8f, 0.9f) == 1);
}

TEST_CASE("no method whose bounds are certified darkens a lit surface in any sweep")
{
    for (const sweep_layer& l : named("filter_passes").layers()) {
        if (l.id != "msm4_unorm16" && l.id != "msm4_float" && l.id != "msm4_half") continue;
        for (const double distance : named("filter_passes").y.values()) {
            INFO(l.id << ", two passes, distance " << distance);
            CHECK(l.error(2, distance) <= 1e-5);
        }
    }
}

TEST_CASE("four moments darken no receiver in blended fog where they allow for blends, and do where they do not")
{
    for (const fog_map& m : fog_maps()) {
        if (!m.id.starts_with("moments4_") && m.id != "msm4_unorm16") continue;
        double worst = 0;
        for (const auto& fog : {std::pair{10, 0.3f}, {200, 0.1f}, {1000, 0.01f}, {1000, 0.001f}}) {
            const std::vector<float> opacities(std::size_t(fog.first), fog.second);
            worst = std::max(worst, errors_in_fog(m, opacities, fog.second).darkening);
        }
        INFO(m.id);
        if (m.id == "msm4_unorm16") CHECK(worst > 0.3);
        else CHECK(worst < 1e-5);
    }
}

TEST_CASE("an alpha test takes as much light as the fragments that it leaves out, from any map")
{
    const std::array opacities{0.2f, 0.009f, 0.3f, 0.008f, 0.007f};
    const double lost = 0.8 * 0.7 * (1 - 0.991 * 0.992 * 0.993);
    for (const fog_map& m : fog_maps())
        if (m.id == "moments4_float_blended" || m.id == "absorbance4_float" || m.id == "evsm_float")
            CHECK(errors_in_fog(m, opacities, 0.01f).leak == doctest::Approx(lost).epsilon(0.1));
}

TEST_CASE("more bits of a format never enlarge the failing region of two surfaces")
{
    const auto failing = [](const char* id) {
        for (const sweep_layer& l : named("two_surfaces").layers()) {
            if (l.id != id) continue;
            std::size_t count = 0;
            for (const std::string& row : failures(named("two_surfaces"), l))
                count += std::size_t(std::ranges::count(row, '#'));
            return count;
        }
        return std::size_t(-1);
    };
    CHECK(failing("msm4_float") < failing("msm4_unorm16"));
    CHECK(failing("msm4_unorm16") < failing("msm4_half"));
    CHECK(failing("msm6_float") < failing("msm6_unorm16"));
    CHECK(failing("msm6_unorm16") < failing("msm6_unorm10"));
    CHECK(failing("evsm_float") < failing("evsm_half"));
}
