#include "comparison.hpp"

namespace gnomon::evaluation {

namespace {

// A scene of contacts, where lit surfaces lie close behind what shadows them, by every method.
void contact(const settings& how)
{
    compare_methods({.driver = "contact",
                     .scene = "contact",
                     .summary = "Shadows where things touch: which methods darken a lit surface close behind a caster.",
                     .of_insets = "darkened",
                     .first = {"msm4_unorm16_raised", "msm4_unorm16"}},
                    how);
}

const registered<driver> entry{driver{.id = "contact", .label = "Contact", .order = 12, .run = contact}};

} // namespace

} // namespace gnomon::evaluation
