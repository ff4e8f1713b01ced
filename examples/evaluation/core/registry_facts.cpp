#include "registry_facts.hpp"

#include "driver.hpp"
#include "method.hpp"
#include "scene.hpp"

#include <nlohmann/json.hpp>

namespace gnomon::evaluation {

namespace {

using json = nlohmann::ordered_json;

template <class Kind> json listed()
{
    json result = json::array();
    for (const Kind* one : registry_of<Kind>().all()) result.push_back({{"id", one->id}, {"label", one->label}});
    return result;
}

json methods()
{
    json result = json::array();
    for (const method* m : methods_in_order())
        result.push_back({{"id", m->id},
                          {"label", m->label},
                          {"family", m->family},
                          {"map", m->map},
                          {"format", m->format.id},
                          {"bytes_per_texel", m->format.bytes_per_texel}});
    return result;
}

} // namespace

std::string registry_facts()
{
    return json{{"families", listed<family>()},    {"methods", methods()},
                {"maps", listed<map_kind>()},      {"receivers", listed<receiver_kind>()},
                {"scenes", listed<scene_entry>()}, {"references", listed<reference>()},
                {"drivers", listed<driver>()}}
        .dump(1);
}

} // namespace gnomon::evaluation
