// All storage formats as types, and the list of them.
#ifndef GNOMON_STORAGE_FORMATS_HPP
#define GNOMON_STORAGE_FORMATS_HPP

#include "convolution.hpp"
#include "exponential.hpp"
#include "exponential_variance.hpp"
#include "layered_variance.hpp"
#include "moments4.hpp"
#include "moments6.hpp"
#include "variance.hpp"

#include <tuple>

GNOMON_NAMESPACE_BEGIN

using storage_formats =
    std::tuple<variance_unorm16, layered_variance_unorm16, exponential_float, exponential_variance_half,
               exponential_variance_float, convolution_unorm8, moments4_unorm16, moments4_half, moments4_float,
               moments6_unorm10, moments6_unorm16, moments6_float>;

GNOMON_NAMESPACE_END
#endif
