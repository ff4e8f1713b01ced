#include "renderer/import/model.hpp"

#include "comparison.hpp"

namespace gnomon::evaluation {

namespace {

// A model from a file on a ground plane, by every method.
void model(const settings& how)
{
    const double aspect = double(how.width) / how.height;
    compare_methods("model", renderer::model_stage(renderer::load_model(how.model.file), aspect), how);
}

const registered<driver> entry{
    driver{.id = "model", .label = "A model", .order = 70, .run = model, .of = subject::model}};

} // namespace

} // namespace gnomon::evaluation
