// Scenes and references as the registry knows them.
#pragma once

#include "registry.hpp"
#include "renderer/scene/stage.hpp"

#include <functional>
#include <string>
#include <utility>

namespace gnomon::evaluation {

struct scene_facts {
    std::string id, label;
    double order = 0;
    std::string text{}; // for the gallery: what the scene shows
};

class scene_entry : public scene_facts {
  public:
    using kind = scene_entry;
    static constexpr const char* kind_name = "scene";

    explicit scene_entry(scene_facts facts) : scene_facts(std::move(facts)) {}
    scene_entry(const scene_entry&) = delete;
    scene_entry& operator=(const scene_entry&) = delete;
    virtual ~scene_entry() = default;
};

// A scene in which nothing moves.
class still_scene : public scene_entry {
  public:
    still_scene(scene_facts facts, std::function<renderer::stage(double aspect)> make)
        : scene_entry(std::move(facts)), stage(std::move(make))
    {}

    const std::function<renderer::stage(double aspect)> stage;
};

// The answer that a row is compared with.
class reference {
  public:
    using kind = reference;
    static constexpr const char* kind_name = "reference";

    reference(std::string its_id, std::string its_label, double its_order)
        : id(std::move(its_id)), label(std::move(its_label)), order(its_order)
    {}
    reference(const reference&) = delete;
    reference& operator=(const reference&) = delete;
    virtual ~reference() = default;

    const std::string id, label;
    const double order;
};

} // namespace gnomon::evaluation
