#include "tree.hpp"

#include "tube.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace gnomon::renderer {

namespace {

class grower {
  public:
    grower(mesh& wood, mesh& leaves, const tree_form& form, float height, std::uint32_t seed)
        : wood_(wood), leaves_(leaves), form_(form), leaf_(0.030f * height), random_(seed)
    {}

    void grow(const glm::vec3& from, const glm::vec3& direction, float length, float radius, int sides, int segments,
              std::size_t depth)
    {
        std::vector<glm::vec3> path{from};
        glm::vec3 along = direction;
        const float step = length / static_cast<float>(segments);
        for (int i = 0; i < segments; ++i) {
            along = glm::normalize(along + 0.18f * anywhere() + glm::vec3(0, 0.08f, 0));
            path.push_back(path.back() + step * along);
        }
        add_tube(wood_, path, radius, sides);
        const auto at = [&](float share) {
            const float place = share * static_cast<float>(segments);
            const auto i = glm::min(static_cast<std::size_t>(place), path.size() - 2);
            return glm::mix(path[i], path[i + 1], place - static_cast<float>(i));
        };
        if (depth == form_.branches.size()) {
            for (int i = 0; i < form_.leaves; ++i) add_leaf(at(between(0.2f, 1)) + leaf_ * 1.6f * anywhere());
            return;
        }
        const generation& next = form_.branches[depth];
        for (int i = 0; i < next.count; ++i) {
            const float share =
                glm::mix(next.first, 1.f, (static_cast<float>(i) + 0.9f) / static_cast<float>(next.count));
            glm::vec3 aside = anywhere();
            aside = glm::normalize(aside - glm::dot(aside, along) * along);
            // Branches are shorter towards the tip.
            const float shrink = 1.25f - 0.75f * share;
            grow(at(share), glm::normalize(along + next.spread * aside), shrink * next.length * length,
                 next.radius * radius, next.sides, next.segments, depth + 1);
        }
    }

  private:
    float between(float low, float high) { return glm::mix(low, high, static_cast<float>(random_() >> 8) * 0x1p-24f); }

    // A point of the unit ball, not its centre.
    glm::vec3 anywhere()
    {
        for (;;) {
            const glm::vec3 point(between(-1, 1), between(-1, 1), between(-1, 1));
            if (const float squared = glm::dot(point, point); squared > 0.01f && squared < 1) return point;
        }
    }

    void add_leaf(const glm::vec3& centre)
    {
        const glm::vec3 length = glm::normalize(anywhere());
        const glm::vec3 other = anywhere();
        const glm::vec3 width = glm::normalize(other - 0.999f * glm::dot(other, length) * length);
        const float size = leaf_ * between(0.7f, 1.1f);
        add_quad(leaves_, centre - 0.5f * size * length - 0.3f * size * width, size * length, 0.6f * size * width);
    }

    mesh &wood_, &leaves_;
    const tree_form& form_;
    float leaf_;
    std::mt19937 random_;
};

} // namespace

tree_form broad_leaved() { return {{{11, 5, 3, 0.46f, 0.42f, 1.1f, 0.30f}, {5, 3, 2, 0.48f, 0.40f, 0.9f, 0.30f}}, 24}; }

void add_tree(mesh& wood, mesh& leaves, const glm::vec3& foot, float height, std::uint32_t seed, const tree_form& form)
{
    grower(wood, leaves, form, height, seed).grow(foot, {0, 1, 0}, 0.72f * height, 0.028f * height, 8, 4, 0);
}

} // namespace gnomon::renderer
