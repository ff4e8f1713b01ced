// Moments over time of what a texel of the light sees while the shutter is open, in closed form from its resolved
// ranges: the filterable shadow map of motion that Palmer 2011 leaves as future work. The depth of a range is a line
// over time, so the mean of its power z^j is (z0^j + z0^(j-1) z1 + ... + z1^j) / (j + 1), and nothing cancels for depths
// of one sign. There is no noise: the moments are those that stochastic samples converge to.
//
// The result is a texel of a moment shadow map. It goes through any storage format and any linear filter, and gives the
// bounds on the shadow of a static receiver (moments/hamburger4.h). Time is collapsed: a receiver that moves with its
// caster gets the shadow of all times.
//
//     state = range_moments4_begin(1);
//     state = range_moments4_add(state, range);    for every range of the resolved list
//     b = range_moments4_end(state);
#ifndef GNOMON_MOTION_RANGE_RANGE_MOMENTS_H
#define GNOMON_MOTION_RANGE_RANGE_MOMENTS_H
#include "../../moments/moments.h"
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// The sum of moments weighted by time, the time that is covered, and the depth of the times that are not.
GNOMON_STRUCT(range_moments4)
{
    GNOMON_T(moments4) sum;
    Real covered, background;
};

GNOMON_CONSTANT(range_moments_third, 0.33333333333333333333);
GNOMON_CONSTANT(range_moments_fifth, 0.2);

/// The means of the first four powers of depth over the time of a range.
/// Domain: depths in [-1, 1].
/// NaN: NaN.
/// Error: 4 2^-p.
GNOMON_KERNEL GNOMON_T(moments4) range_mean_moments4(GNOMON_T(depth_time_range) r)
{
    Real product = r.z0 * r.z1;
    Real squares = r.z0 * r.z0 + r.z1 * r.z1;
    GNOMON_T(moments4) m;
    m.b1 = Real(0.5) * (r.z0 + r.z1);
    m.b2 = GNOMON_LITERAL(range_moments_third) * (squares + product);
    m.b3 = Real(0.5) * (squares * m.b1);
    m.b4 = GNOMON_LITERAL(range_moments_fifth) * ((squares * squares - product * product) + squares * product);
    return m;
}

/// Begin without a range. Times that no range covers have the depth `background`, 1 for a cleared map.
GNOMON_KERNEL GNOMON_T(range_moments4) range_moments4_begin(Real background)
{
    GNOMON_T(range_moments4) state;
    state.sum.b1 = Real(0);
    state.sum.b2 = Real(0);
    state.sum.b3 = Real(0);
    state.sum.b4 = Real(0);
    state.covered = Real(0);
    state.background = background;
    return state;
}

/// Add one range that is disjoint in time from those before.
/// NaN: a range with a NaN adds nothing.
GNOMON_KERNEL GNOMON_T(range_moments4) range_moments4_add(GNOMON_T(range_moments4) state, GNOMON_T(depth_time_range) r)
{
    depth_time_range c = range_clip(r, Real(0), Real(1));
    Real duration = gnomon_select(c.z0 == c.z0 && c.z1 == c.z1, range_duration(c), Real(0));
    GNOMON_MASK some = Real(0) < duration;
    moments4 sum = moments4_add(state.sum, range_mean_moments4(c), duration);
    state.sum.b1 = gnomon_select(some, sum.b1, state.sum.b1);
    state.sum.b2 = gnomon_select(some, sum.b2, state.sum.b2);
    state.sum.b3 = gnomon_select(some, sum.b3, state.sum.b3);
    state.sum.b4 = gnomon_select(some, sum.b4, state.sum.b4);
    state.covered = state.covered + duration;
    return state;
}

/// The moments of depth over the shutter interval.
/// Domain: ranges of a resolved list, depths in [-1, 1].
/// Error: 8 2^-p for each range.
GNOMON_KERNEL GNOMON_T(moments4) range_moments4_end(GNOMON_T(range_moments4) state)
{
    Real open = saturate_or_zero(Real(1) - state.covered);
    return moments4_add(state.sum, moments4_from_depth(state.background), open);
}

GNOMON_NAMESPACE_END
#endif
