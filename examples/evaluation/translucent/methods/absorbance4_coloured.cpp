// Absorbance moments, with an absorbance for each of red, green and blue light.
#include "absorbance.hpp"

namespace gnomon::evaluation {

namespace {

const registered<absorbance_method<coloured_absorbance>> entry{
    method_facts{
        .id = "absorbance4_float_coloured", .family = "absorbance", .label = "Absorbance, coloured", .order = 20},
    translucent_traits{.coloured = true}};

} // namespace

} // namespace gnomon::evaluation
