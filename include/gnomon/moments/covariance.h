// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H
#include "../numerics/two_product.h"
GNOMON_NAMESPACE_BEGIN

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
GNOMON_DETAIL_KERNEL GNOMON_T(double_word) covariance_add_bias(GNOMON_T(double_word) c, Real b_i, Real b_j, Real e_ij,
                                                               Real e_i, Real e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

GNOMON_NAMESPACE_END
#endif
