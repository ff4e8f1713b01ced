#include "renderer/import/model.hpp"

#include "comparison.hpp"
#include "evaluation/core/scene.hpp"

namespace gnomon::evaluation {

namespace {

// A model from a file on a ground plane, by every method.
void model(const settings& how)
{
    const double aspect = double(how.width) / how.height;
    compare_methods({.driver = "model",
                     .scene = "model",
                     .summary = "A model from a file, shadowed by every filter of the library.",
                     .of_insets = "leak",
                     .first = {"evsm_half", "msm4_unorm16"}},
                    how, renderer::model_stage(renderer::load_model(how.model.file), aspect));
}

const registered<driver> entry{
    driver{.id = "model", .label = "A model", .order = 70, .run = model, .of = subject::model}};

const registered<scene_entry> scene{
    scene_facts{.id = "model",
                .label = "a model from a file",
                .order = 100,
                .text = "A model from a file on a ground plane. Its bounds frame the camera and the light."}};

} // namespace

} // namespace gnomon::evaluation
