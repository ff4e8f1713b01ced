// The constants of the library, derived: sparse quantization transforms, bias vectors and bias weights.
#pragma once

#include "bias.hpp"
#include "transform.hpp"

#include <string>
#include <vector>

namespace gnomon::derivation {

/// The matrix that maps moments b_0 to b_m of depths in [0, 1] to those of depths in [-1, 1] (Peters et al. 2017, Eq. 2
/// with 2 z - 1).
small_matrix<wide_real> signed_depth(int m);

/// The odd and the even part of Theta4* (Eq. 3). The last row may be any mean of b2 and b4 without a change of the
/// determinant; the paper's row is the symmetric one.
affine_transform<decimal50> odd4();
affine_transform<decimal50> even4();

/// The odd and the even part of Theta6*. The odd part has half the Chebyshev polynomial T5 and two rows without a
/// short closed form, to 20 digits. The even part, in s = 2 z^2 - 1, is the square beside the odd part of Theta4*
/// and hence closed.
affine_transform<decimal50> odd6();
affine_transform<decimal50> even6();

/// The parts of Theta6* as printed in Sec. 5.4.3, with the transposes that the paper intends.
affine_transform<decimal50> printed_odd6();
affine_transform<decimal50> printed_even6();

/// The whole transform of b_1 to b_m from its odd and its even part, in the paper's order of rows: alternating for
/// m = 4, the odd part first for m = 6.
affine_transform<decimal50> join(const affine_transform<decimal50>& odd, const affine_transform<decimal50>& even);

/// The transform with its entries rounded to double, as the library stores them.
affine_transform<decimal50> rounded(const affine_transform<decimal50>& transform);

/// The largest entry of M^-1 M - 1, both matrices rounded to double.
double inverse_residual(const affine_transform<decimal50>& transform);

/// A bias vector b_1 to b_m with its distances to the boundary of conv b(R) in stored space.
struct bias_vector {
    small_vector<double> moments;
    double maximum_norm, euclidean;
};

/// The bias vectors for one way to store moments.
struct bias_vector_set {
    std::string stored;
    small_matrix<wide_real> transform;
    bias_vector printed, farthest_euclidean, farthest;
};

/// For b1..b4, Theta4*, b1..b6 and Theta6*.
std::vector<bias_vector_set> bias_vectors();

/// A storage format: the largest error of a channel by one rounding, the distances in stored space, and the bias weight
/// of the paper, or 0 if the paper has none.
struct storage_format {
    std::string name;
    double rounding, distance_printed, distance, paper_weight;

    [[nodiscard]] double weight() const { return rounding / distance; }
};

/// The formats of the library, with distances from the bias vectors.
std::vector<storage_format> formats(const std::vector<bias_vector_set>& vectors);

} // namespace gnomon::derivation
