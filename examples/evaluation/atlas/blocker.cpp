// Blocker search in a region with a surface behind the receiver: more surfaces than few moments can tell apart.
#include "rectangles.hpp"
#include "sweep.hpp"

#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::evaluation::blocker {

namespace {

constexpr float search_texels = 784; // of a search of 27 x 27

// How far the width of the penumbra is off, as a share of it.
template <summed_table Table> double error(double distance, double behind)
{
    constexpr float receiver = 0;
    const std::array region{layer{-0.8f, 0.2f}, layer{float(-distance), 0.3f}, layer{receiver, 0.3f},
                            layer{float(behind), 0.2f}};
    const double exact = double(receiver) - exact_blocker(region, receiver);
    const auto c = rectangle_over<Table>(region, double(search_texels), search_texels);
    return std::abs(double(receiver) - double(Table::blocker(c, search_texels, receiver)) - exact) / exact;
}

template <summed_table Table> sweep_layer searched(const char* label)
{
    return {std::string(Table::id) + "_blocker", label, error<Table>};
}

std::vector<sweep_layer> layers()
{
    return {searched<variance_summed>("VSM, 64 bit table"), searched<moments4_summed>("MSM, 128 bit table"),
            searched<moments6_summed>("MSM6, 192 bit table")};
}

const registered<sweep> entry{sweep{
    .id = "blocker",
    .label = "Blocker search",
    .order = 120,
    .text = "A search region of 27 x 27 texels shows two blockers, the surface of the receiver and one behind it. A "
            "method fails where the width of the penumbra, which is proportional to the distance of the mean "
            "blocker, is off by a quarter.",
    .x = {"distance", "distance of the receiver from the nearer blocker", scale::log, 1e-3, 0.75, 30},
    .y = {"behind", "distance of the surface behind the receiver", scale::log, 1e-3, 0.95, 16},
    .error_label = "error of the width of the penumbra",
    .threshold = 0.25,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::blocker
