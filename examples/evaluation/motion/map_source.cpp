#include "map_source.hpp"

#include "range_method.hpp"
#include "renderer/scene/surface_ids.hpp"

#include <stdexcept>

namespace gnomon::evaluation {

std::shared_ptr<const range_shadow_map> map_source::map(std::string_view method, const parameters& how)
{
    const std::pair key(std::string(method), how);
    if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    const auto* of = dynamic_cast<const range_method*>(&registry_of<evaluation::method>().at(method));
    if (!of) throw std::invalid_argument(key.first + " has no map of ranges");
    auto result = std::make_shared<const range_shadow_map>(of->build(*this, how));
    if (of->is_shared()) kept_[key] = result;
    return result;
}

std::span<const std::uint32_t> map_source::surface_ids()
{
    if (!ids_) ids_ = renderer::surface_ids(world);
    return *ids_;
}

} // namespace gnomon::evaluation
