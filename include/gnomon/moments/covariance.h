// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words: they cancel to nothing over a single surface, and
// what is left decides the shadow. Shared by the factored Hankel matrices of four and of six moments.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H
#include "../numerics/two_product.h"
GNOMON_NAMESPACE_BEGIN

/// (b_ij + e_ij) - (b_i + e_i) (b_j + e_j), the covariance after a small change e of the moments, such as a bias, that
/// would be rounded away if it were added to them; c = b_ij - b_i b_j. High stays that of c, low takes the change.
GNOMON_KERNEL GNOMON_T(double_word) covariance_add_bias(GNOMON_T(double_word) c, Real b_i, Real b_j, Real e_ij,
                                                        Real e_i, Real e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

GNOMON_NAMESPACE_END
#endif
