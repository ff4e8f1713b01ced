// Absorbance moments, grey (Munstermann et al. 2018).
#include "absorbance.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> absorbance{
    family{.id = "absorbance", .label = "absorbance moments", .order = 90, .colour = "#17a2b8"}};

const registered<absorbance_method<grey_absorbance>> entry{
    method_facts{.id = "absorbance4_float", .family = "absorbance", .label = "Absorbance, 4 moments", .order = 10},
    translucent_traits{}};

} // namespace

} // namespace gnomon::evaluation
