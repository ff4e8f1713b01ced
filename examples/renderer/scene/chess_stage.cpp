#include "layered_stages.hpp"
#include "moving_stage_builder.hpp"
#include "paint.hpp"
#include "tube.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::renderer {

namespace {

constexpr float square = 0.6f, board_top = 0.1f; // side of a square, height of the board

enum class piece { pawn, rook, knight, bishop, queen, king };

constexpr std::array first_rank{piece::rook, piece::knight, piece::bishop, piece::queen,
                                piece::king, piece::bishop, piece::knight, piece::rook};

// Outlines in parts of height and largest radius: a foot, a stem and a collar, and heads from pawn to king.
constexpr std::array<turned_circle, 11> stem{{{1, 0},
                                              {1, 0.07f},
                                              {0.8f, 0.12f},
                                              {0.82f, 0.15f},
                                              {0.55f, 0.22f},
                                              {0.42f, 0.32f},
                                              {0.36f, 0.44f},
                                              {0.34f, 0.55f},
                                              {0.36f, 0.6f},
                                              {0.62f, 0.63f},
                                              {0.38f, 0.67f}}};
constexpr std::array<std::array<turned_circle, 4>, 6> heads{{
    {{{0.5f, 0.74f}, {0.54f, 0.83f}, {0.4f, 0.94f}, {0.1f, 1}}},
    {{{0.5f, 0.72f}, {0.66f, 0.76f}, {0.66f, 0.98f}, {0.6f, 1}}},
    {{{0.3f, 0.69f}, {0.2f, 0.7f}, {0.1f, 0.71f}, {0.05f, 0.72f}}},
    {{{0.46f, 0.74f}, {0.5f, 0.82f}, {0.25f, 0.95f}, {0.08f, 1}}},
    {{{0.45f, 0.74f}, {0.72f, 0.93f}, {0.3f, 0.95f}, {0.12f, 1}}},
    {{{0.45f, 0.74f}, {0.66f, 0.92f}, {0.3f, 0.95f}, {0.1f, 1}}},
}};
constexpr std::array heights{0.5f, 0.58f, 0.8f, 0.78f, 0.95f, 0.95f}, radii{0.16f, 0.2f, 0.2f, 0.19f, 0.22f, 0.22f};

// A piece on a foot, which looks along z or against it.
void add_piece(mesh& target, piece kind, const glm::vec3& foot, float forward)
{
    const auto index = static_cast<std::size_t>(kind);
    const float height = heights[index], radius = radii[index];
    std::array<turned_circle, 15> outline;
    std::ranges::copy(heads[index], std::ranges::copy(stem, outline.begin()).out);
    for (turned_circle& circle : outline) circle = {radius * circle.radius, height * circle.height};
    add_turned(target, foot, outline, 30);
    const auto at = [&](float up, float ahead) { return foot + glm::vec3(0, up, forward * ahead); };
    if (kind == piece::king) {
        add_box(target, upright(at(height + 0.06f, 0), {0.03f, 0.14f, 0.03f}));
        add_box(target, upright(at(height + 0.07f, 0), {0.1f, 0.03f, 0.028f}));
    }
    if (kind == piece::knight) {
        const glm::vec3 ahead(0, 0, forward), up(0, 1, 0), across = glm::cross(ahead, up);
        const std::array<glm::vec2, 6> neck{{{-0.8f, -1}, {0.7f, -1}, {1, 0}, {0.5f, 0.8f}, {0, 1}, {-0.7f, 0.6f}}};
        add_prism(target, neck, {at(0.67f, 0), {0.12f * ahead, 0.16f * up, 0.05f * across}});
        const std::array<glm::vec2, 5> muzzle{{{-1, -0.6f}, {0.8f, -1}, {1, -0.2f}, {0.2f, 0.6f}, {-1, 1}}};
        add_prism(target, muzzle, {at(0.73f, 0.12f), {0.12f * ahead, 0.07f * up, 0.045f * across}});
    }
}

struct move {
    int rank, file;
    glm::vec3 by;
};

// Of the squares below: pawns that advance, knights that jump over them.
const std::array moves{move{1, 4, {0, 0, -0.8f}}, move{6, 4, {0, 0, 0.8f}}, move{6, 2, {0, 0, 0.6f}},
                       move{0, 6, {-0.3f, 0.45f, -0.55f}}, move{7, 1, {0.3f, 0.45f, 0.5f}}};
constexpr int falling_rank = 7, falling_file = 4;

// From upright by an angle towards +z, over the edge of the foot.
void topple(std::span<glm::vec3> positions, const glm::vec3& foot, float angle)
{
    const glm::vec3 edge = foot + glm::vec3(0, 0, radii.back());
    for (glm::vec3& p : positions) {
        const glm::vec3 from = p - edge;
        p = edge + glm::vec3(from.x, std::cos(angle) * from.y - std::sin(angle) * from.z,
                             std::sin(angle) * from.y + std::cos(angle) * from.z);
    }
}

// The piece of a square of the first two ranks of either side.
void add_piece_of(mesh& target, int rank, int file, bool closing)
{
    glm::vec3 foot(square * (static_cast<float>(file) - 3.5f), board_top, square * (3.5f - static_cast<float>(rank)));
    if (closing)
        for (const move& one : moves)
            if (one.rank == rank && one.file == file) foot += one.by;
    const bool front = rank == 1 || rank == 6;
    const std::size_t before = target.positions.size();
    add_piece(target, front ? piece::pawn : first_rank[static_cast<std::size_t>(file)], foot, rank < 4 ? -1.f : 1.f);
    if (closing && rank == falling_rank && file == falling_file)
        topple(std::span(target.positions).subspan(before), foot, 0.7f);
}

} // namespace

moving_stage chess(double aspect)
{
    std::array board{painted("light squares", {0.62f, 0.55f, 0.42f}), painted("dark squares", {0.34f, 0.24f, 0.17f})};
    for (int rank = 0; rank < 8; ++rank)
        for (int file = 0; file < 8; ++file)
            add_box(board[static_cast<std::size_t>((rank + file + 1) % 2)],
                    upright({square * (static_cast<float>(file) - 3.5f), 0.5f * board_top,
                             square * (3.5f - static_cast<float>(rank))},
                            {square, board_top, square}));
    moving_scene casters{{"chess", {}}, {}};
    for (const bool black : {false, true}) {
        const mesh none = black ? painted("black", {0.30f, 0.17f, 0.11f}) : painted("white", {0.78f, 0.72f, 0.6f});
        std::array both{none, none};
        for (const bool closing : {false, true})
            for (const int rank : {black ? 6 : 0, black ? 7 : 1})
                for (int file = 0; file < 8; ++file) add_piece_of(both[closing], rank, file, closing);
        add(casters, both[0], both[1]);
    }
    for (const mesh& squares : board) add(casters, squares, glm::vec3(0));
    return on_ground(casters, {{3, 7, 2}, {3, 7, 2}}, {{0, 4, 6}, {0, 0.3, 0}, 40}, aspect,
                     {{"pawn", "pawn on its way", {0.1f, 0.1f, 0.9f}, paint::green},
                      {"king", "falling king", {0, 0.1f, -1.5f}, paint::cyan}});
}

} // namespace gnomon::renderer
