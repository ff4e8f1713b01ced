#include "layered_method.hpp"

double gnomon::evaluation::value_of(const parameters& some, const std::string& name, double otherwise)
{
    const auto found = some.find(name);
    return found == some.end() ? otherwise : found->second;
}
