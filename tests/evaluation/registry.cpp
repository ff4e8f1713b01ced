// Registries: their order, what they refuse, and what the program's own hold.
#include "evaluation/core/registry.hpp"

#include "evaluation/core/method.hpp"

#include <doctest/doctest.h>

#include <array>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace gnomon::evaluation;

namespace {

struct thing {
    using kind = thing;
    static constexpr const char* kind_name = "thing";

    std::string id, label{};
    double order = 0;

    virtual ~thing() = default;
};

struct rare_thing : thing {};

template <class Thing = thing> Thing named(std::string_view id, double order = 0)
{
    Thing result;
    result.id = std::string(id);
    result.order = order;
    return result;
}

std::string ids(const auto& entries)
{
    std::string result;
    for (const auto* one : entries) result += one->id + " ";
    return result;
}

} // namespace

TEST_CASE("entries are sorted by order, then by id, and found by id")
{
    registry<thing> things;
    const thing a = named("a", 1), b = named("b"), c = named("c");
    const rare_thing d = named<rare_thing>("d");
    for (const thing* one : std::vector<const thing*>{&c, &a, &d, &b}) things.add(*one);
    CHECK(ids(things.all()) == "b c d a ");
    CHECK(ids(things.all_of<rare_thing>()) == "d ");
    CHECK(&things.at("c") == &c);
    CHECK(things.find("e") == nullptr);
    CHECK_THROWS_WITH_AS(static_cast<void>(things.at("e")), "no thing has the id e", std::invalid_argument);
}

TEST_CASE("an id that two share, or that is none, is refused")
{
    for (const auto& [first, second, cause] : {std::array{"a", "a", "registry of kind thing: two have the id a"},
                                               std::array{"a", "b c", "registry of kind thing: no id: b c"}}) {
        registry<thing> things;
        const thing one = named(first), other = named(second);
        things.add(one), things.add(other);
        CHECK_THROWS_WITH_AS(static_cast<void>(things.all()), cause, std::logic_error);
    }
    for (const char* text : {"", "_a", "a_", "a__b", "A", "1", "a-_b", "-a", "a b"}) CHECK(!is_id(text));
    for (const char* text : {"a", "a1", "msm4_unorm16", "closed-form"}) CHECK(is_id(text));
}

TEST_CASE("an entry registers itself in the registry of its kind")
{
    static const registered<rare_thing> one(named<rare_thing>("rare"));
    CHECK(registry_of<thing>().all_of<rare_thing>() == std::vector{&*one});
}

TEST_CASE("every method has a family, a map, a format and a place of its own")
{
    std::set<std::pair<std::string, double>> places;
    const std::vector<const method*> all = methods_in_order();
    CHECK(all.size() >= 17);
    double previous = -1;
    for (const method* m : all) {
        CAPTURE(m->id);
        CHECK(!m->label.empty());
        CHECK(is_id(m->format.id));
        CHECK(m->format.bytes_per_texel > 0);
        CHECK(registry_of<map_kind>().find(m->map) != nullptr);
        CHECK(places.insert({m->family, m->order}).second);
        CHECK(m->its_family().order >= previous);
        CHECK(m->its_family().colour.size() == 7);
        previous = m->its_family().order;
    }
}
