// The coverage map of Hong & Oh ("Efficient motion blurred shadows using a temporal shadow map", 2017): texels that one
// surface covers throughout the shutter, found from fragments of prisms (prism.h) in passes over the geometry.
// motion/range/range_cover.h finds the same covers in one pass from ranges.
//
// The nearest map holds time and id of the nearest fragment. A fragment with the same id and a time that differs by 1
// shows that the triangle is there at shutter open and at close: a cover. A fragment with another id in front of the
// cover revokes the cover. The paper compares with whichever end of the cover its second pass wrote last, since the
// depth test is off; this text compares with the farther end, which is independent of order and conservative. A third
// fragment with the cover's own id revokes the cover as well, since the triangle left and returned; the paper lets such
// a fragment pass. A cover that remains is in front at all times if depth is linear between the fragments. The paper's
// second and third pass are one pass here, since no order matters:
//
//     nearest = nearest_fragment_begin(1);       nearest = nearest_fragment_add(nearest, f);   for all f
//     state = fragment_cover_begin(nearest);     state = fragment_cover_add(state, f);         for all f
//     cover = fragment_cover_end(state);
#ifndef GNOMON_COMPARATORS_THREE_PASS_COVER_H
#define GNOMON_COMPARATORS_THREE_PASS_COVER_H
#include "../motion/range/range.h"
GNOMON_NAMESPACE_BEGIN

/// A fragment: time t in [0, 1], depth z in [-1, 1], and the id of a triangle, a whole number from 0.
GNOMON_STRUCT(timed_fragment) { Real t, z, id; };

/// The nearest fragment; the number of fragments with its id, the farthest depth of these, and ends, 1 if one of these
/// is at the other end of the shutter, else 0; front, the nearest depth of all other fragments.
GNOMON_STRUCT(fragment_cover)
{
    GNOMON_T(timed_fragment) nearest;
    Real count, far_depth, ends, front;
};

/// The state before the first fragment. Only fragments nearer than `cleared`, the depth of the cleared map, are kept.
GNOMON_KERNEL GNOMON_T(timed_fragment) nearest_fragment_begin(Real cleared)
{
    GNOMON_T(timed_fragment) r;
    r.t = Real(0);
    r.z = cleared;
    r.id = Real(-1);
    return r;
}

/// The nearer of two fragments; at the same depth the one with the lesser id, then the earlier one.
/// Domain: f with id >= 0 and time in [0, 1]; others are ignored.
/// NaN: f is ignored.
/// Source: Hong & Oh 2017
GNOMON_KERNEL GNOMON_T(timed_fragment) nearest_fragment_add(GNOMON_T(timed_fragment) nearest,
                                                            GNOMON_T(timed_fragment) f)
{
    GNOMON_MASK before = f.id < nearest.id || (f.id == nearest.id && f.t < nearest.t);
    GNOMON_MASK known = Real(0) <= f.id && Real(0) <= f.t && f.t <= Real(1);
    GNOMON_MASK taken = known && (f.z < nearest.z || (f.z == nearest.z && before));
    nearest.t = gnomon_select(taken, f.t, nearest.t);
    nearest.z = gnomon_select(taken, f.z, nearest.z);
    nearest.id = gnomon_select(taken, f.id, nearest.id);
    return nearest;
}

/// The state before the first fragment of the second pass, from the result of the first pass.
GNOMON_KERNEL GNOMON_T(fragment_cover) fragment_cover_begin(GNOMON_T(timed_fragment) nearest)
{
    GNOMON_T(fragment_cover) state;
    state.nearest = nearest;
    state.count = Real(0);
    state.far_depth = nearest.z;
    state.ends = Real(0);
    state.front = Real(1);
    return state;
}

/// The state after one more fragment, in any order. The nearest fragment must be among them.
/// Domain: f with id >= 0 and time in [0, 1]; others are ignored.
/// NaN: f is ignored.
/// Source: Hong & Oh 2017
GNOMON_KERNEL GNOMON_T(fragment_cover) fragment_cover_add(GNOMON_T(fragment_cover) state, GNOMON_T(timed_fragment) f)
{
    GNOMON_MASK known = Real(0) <= f.id && Real(0) <= f.t && f.t <= Real(1) && f.z == f.z;
    GNOMON_MASK same = known && f.id == state.nearest.id;
    GNOMON_MASK other = known && !(f.id == state.nearest.id);
    GNOMON_MASK end = same && Real(1) <= gnomon_abs(f.t - state.nearest.t);
    state.count = state.count + gnomon_select(same, Real(1), Real(0));
    state.ends = gnomon_select(end, Real(1), state.ends);
    state.far_depth = gnomon_select(same && state.far_depth < f.z, f.z, state.far_depth);
    state.front = gnomon_select(other && f.z < state.front, f.z, state.front);
    return state;
}

/// The cover as a range over the whole shutter, or an empty range if there is none.
GNOMON_KERNEL GNOMON_T(depth_time_range) fragment_cover_end(GNOMON_T(fragment_cover) state)
{
    GNOMON_MASK alone = state.count == Real(2) && state.far_depth <= state.front;
    GNOMON_MASK known = Real(0) <= state.nearest.id && Real(-1) <= state.nearest.z;
    GNOMON_MASK covers = known && Real(0) < state.ends && alone;
    timed_fragment n = state.nearest;
    depth_time_range cover = range_between(n.t, n.z, Real(1) - n.t, state.far_depth, n.id);
    return range_select(covers, cover, range_empty(Real(-1)));
}

GNOMON_NAMESPACE_END
#endif
