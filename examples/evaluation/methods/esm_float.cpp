// Exponential shadow maps (Annen et al. 2008).
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> esm{family{.id = "esm", .label = "exponential shadow maps", .order = 40, .colour = "#9467bd"}};

const registered<filterable<exponential_float>> entry{
    method_facts{.id = "esm_float", .family = "esm", .label = "ESM 32 bit", .order = 10}};

} // namespace

} // namespace gnomon::evaluation
