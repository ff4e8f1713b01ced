#include "renderer/import/model.hpp"

#include "comparison.hpp"

void gnomon::evaluation::model(const settings& how, const std::filesystem::path& file)
{
    compare_methods("model", renderer::model_stage(renderer::load_model(file), double(how.width) / how.height), how);
}
