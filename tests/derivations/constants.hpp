// What the library stores, derived: the sparse quantization transforms, the bias vectors and the bias weights.
#pragma once

#include "bias.hpp"
#include "transform.hpp"

#include <string>
#include <vector>

namespace gnomon::derivation {

/// Moments b_0 to b_m of depths in [0, 1] to those of depths in [-1, 1]: z -> 2 z - 1 in equation (2).
Matrix<Real> signed_depth(int m);

/// Theta4* (equation 3), b1 and b3 apart from b2 and b4. The last row may be any mean of b2 and b4: all have this
/// determinant, and the paper's is the symmetric one.
Transform<Decimal50> odd4();
Transform<Decimal50> even4();

/// The parts of Theta6*. The odd one is half the Chebyshev polynomial T5 and two rows without a short closed form, to
/// 20 digits. The even one, in s = 2 z^2 - 1, is the square beside the odd part of Theta4*, hence closed.
Transform<Decimal50> odd6();
Transform<Decimal50> even6();

/// The parts of Theta6* as printed in section 5.4.3, transposed as they are meant.
Transform<Decimal50> printed_odd6();
Transform<Decimal50> printed_even6();

/// The whole transform of b_1 to b_m from its odd and its even part, in the paper's order of rows: alternating for
/// m = 4, the odd part first for m = 6.
Transform<Decimal50> join(const Transform<Decimal50>& odd, const Transform<Decimal50>& even);

/// With the entries rounded to double, as the library stores them.
Transform<Decimal50> rounded(const Transform<Decimal50>& transform);

/// The largest entry of M^-1 M - 1, both matrices rounded to double.
double inverse_residual(const Transform<Decimal50>& transform);

/// A bias vector b_1 to b_m with its distances to the boundary of conv b(R) in stored space.
struct BiasVector {
    Vector<double> moments;
    double maximum_norm, euclidean;
};

struct BiasVectors {
    std::string stored;
    Matrix<Real> transform;
    BiasVector printed, farthest_euclidean, farthest;
};

/// For b1..b4, Theta4*, b1..b6 and Theta6*.
std::vector<BiasVectors> bias_vectors();

/// A storage format: the most that one rounding of a stored vector moves a channel, the stored space's distances, and
/// the bias weight of the paper (0 where it has none).
struct Format {
    std::string name;
    double rounding, distance_printed, distance, paper_weight;

    [[nodiscard]] double weight() const { return rounding / distance; }
};

std::vector<Format> formats(const std::vector<BiasVectors>& vectors);

} // namespace gnomon::derivation
