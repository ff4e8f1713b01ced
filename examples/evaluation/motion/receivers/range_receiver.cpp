#include "range_receiver.hpp"

#include <stdexcept>
#include <string>

namespace gnomon::evaluation {

const range_receiver& range_receiver_of(std::string_view id)
{
    const auto* found = dynamic_cast<const range_receiver*>(&registry_of<receiver_kind>().at(id));
    if (!found) throw std::invalid_argument(std::string(id) + " looks up no map of ranges");
    return *found;
}

} // namespace gnomon::evaluation
