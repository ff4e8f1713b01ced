#include "method.hpp"

#include <algorithm>

std::vector<const gnomon::evaluation::method*> gnomon::evaluation::methods_in_order()
{
    std::vector<const method*> result = registry_of<method>().all();
    const auto family_order = [](const method* m) {
        return std::pair(m->its_family().order, std::string_view(m->family));
    };
    std::ranges::stable_sort(result, {}, family_order);
    return result;
}
