// The mean depth of blockers from six moments: blocker.h, for search regions that hold more surfaces.
//
// hamburger6.h finds a single node, which is alone on its side of z_f. The mean of (x - z_f) over all nodes is -u, so
// the sum A of w (z_f - x) over the nodes x before z_f is
//     all before z_f:        u
//     the lone one before:   w (z_f - x)            of that node
//     the lone one behind:   u + w (x - z_f)
//     none:                  0
#ifndef GNOMON_SOFT_BLOCKER6_H
#define GNOMON_SOFT_BLOCKER6_H
#include "../moments/hamburger6.h"
#include "blocker.h"
GNOMON_NAMESPACE_BEGIN

/// Mean blocker depth in [-1, z_f] from six moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 1e-14, p99.9 1e-13
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel6_from_summed: p99 1e-3, p99.9 5e-3, max 5e-1
/// Source: Peters 2017, Eq. 4
GNOMON_KERNEL Real blocker6_depth(GNOMON_T(hankel6) h, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    hamburger6_sums s = hamburger6_sums_at(h, z - h.mean);
    return blocker_depth_before(z, s.distance / (GNOMON_LITERAL(blocker_epsilon) + gnomon_max(s.lower, Real(0))));
}

GNOMON_NAMESPACE_END
#endif
