#include "toolbox/model.hpp"

#include "comparison.hpp"

void gnomon::demo::model(const settings& how, const std::filesystem::path& file)
{
    compare_methods("model", toolbox::model_stage(toolbox::load_model(file), double(how.width) / how.height), how);
}
