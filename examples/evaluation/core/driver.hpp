// The drivers of the demo. Each leaves pictures and a page of facts, FOLDER/NAME/facts.json, for the gallery, and rows
// in report.json.
#pragma once

#include "progress.hpp"
#include "registry.hpp"
#include "settings.hpp"

#include <string>

namespace gnomon::evaluation {

// The subject of a driver: scenes of its own, a model from a file, or such a model in motion.
enum class subject { own, model, animation };

struct driver {
    using kind = driver;
    static constexpr const char* kind_name = "driver";

    std::string id, label;
    double order = 0;
    void (*run)(const settings& how) = nullptr;
    subject of = subject::own;
    std::string scenes_of{}; // id of the driver whose scenes the model stands in for; none where it is empty
};

} // namespace gnomon::evaluation
