// Receivers of soft shadows as floats and as packs.
#pragma once

#include "evaluation/core/lanes.hpp"
#include "soft_method.hpp"

namespace gnomon::evaluation {

// Group i of receivers.
template <class Real> soft_place<Real> place_of(std::span<const soft_receiver> where, std::size_t group)
{
    return gathered<soft_place, Real>([&](std::size_t lane) { return where[group * lanes_of<Real> + lane]; });
}

} // namespace gnomon::evaluation
