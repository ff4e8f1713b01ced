// Texels that one surface covers for the whole of the shutter, in front of everything: the coverage map of Hong & Oh
// ("Efficient motion blurred shadows using a temporal shadow map", 2017). All else in such a texel is hidden at all
// times and need not be kept. A cover is a range from 0 to 1 itself, with the cover's id; where there is none, it is
// empty and has the id -1.
//
// Their way takes the fragments of prisms (prism.h) in three passes over the geometry. The nearest map keeps time and
// id of the nearest fragment. A fragment of the same id at a time that differs by 1 shows the triangle there at shutter
// open and at close: a cover. A fragment of another id in front of the cover takes it back. In front of what, hangs on
// the depth buffer that their second pass writes with its depth test off: it has the cover's other end then, or
// whichever end came last. Taken here is the farther end, whatever the order: who is in front of that for a moment may
// be in front of the cover. A third fragment of the cover's own id takes it back as well, since the triangle left and
// returned; their rule lets it pass. So a cover is in front at all times if depth goes linearly between the fragments.
// Nothing depends on an order any more, and the second and the third pass are one:
//     nearest = nearest_fragment_begin(1);                  nearest = nearest_fragment_add(nearest, f);   for all f
//     state = fragment_cover_begin(nearest);                state = fragment_cover_add(state, f);         for all f
//     cover = fragment_cover_end(state);
//
// In one pass, which they leave for future work, from ranges as moving_coverage gives them, in any order:
//     state = range_cover_begin(1);                         state = range_cover_add(state, r);            for all r
//     cover = range_cover_end(state);
// Ranges that range_cover_hides may be left out of the list; the cover, which hides nothing of itself, stays in it or
// stands for it:
//     answer = range_cover_answer(cover, t, z, id, bias);   the list is asked where this is undecided
#ifndef GNOMON_MOTION_COVERAGE_MAP_H
#define GNOMON_MOTION_COVERAGE_MAP_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// Time in [0, 1], depth in [-1, 1] and a triangle's id, a whole number from 0.
GNOMON_STRUCT moment_fragment { Real t, z, id; };

/// The nearest fragment; how many there are of its id, their farthest depth, and whether one is at the other end of the
/// shutter (1 or 0); nearest depth of all others.
GNOMON_STRUCT fragment_cover
{
    GNOMON_T(moment_fragment) nearest;
    Real count, far_depth, ends, front;
};

/// The best cover so far, and the nearest depth of all others.
GNOMON_STRUCT range_cover
{
    GNOMON_T(depth_time_range) best;
    Real front, far_plane;
};

/// What a cover says of a receiver: shadow intensity, 0 or 1, and whether that is all (1) or the list has to be asked.
GNOMON_STRUCT cover_answer { Real intensity, decided; };

GNOMON_CONSTANT(cover_margin, 0.0000019073486328125); // 2^-19, 32 2^-p in float

/// The depth that the map is cleared to, 1; only what is nearer than that is there.
GNOMON_KERNEL GNOMON_T(moment_fragment) nearest_fragment_begin(Real cleared)
{
    GNOMON_T(moment_fragment) r;
    r.t = Real(0);
    r.z = cleared;
    r.id = Real(-1);
    return r;
}

/// The nearer of the two, of the same depth that with the lesser id, then the earlier. NaN, or an id below 0: no
/// change.
GNOMON_KERNEL GNOMON_T(moment_fragment)
    nearest_fragment_add(GNOMON_T(moment_fragment) nearest, GNOMON_T(moment_fragment) f)
{
    GNOMON_MASK before = f.id < nearest.id || (f.id == nearest.id && f.t < nearest.t);
    GNOMON_MASK known = Real(0) <= f.id && Real(0) <= f.t && f.t <= Real(1);
    GNOMON_MASK taken = known && (f.z < nearest.z || (f.z == nearest.z && before));
    nearest.t = gnomon_select(taken, f.t, nearest.t);
    nearest.z = gnomon_select(taken, f.z, nearest.z);
    nearest.id = gnomon_select(taken, f.id, nearest.id);
    return nearest;
}

/// After all fragments have been through nearest_fragment_add.
GNOMON_KERNEL GNOMON_T(fragment_cover) fragment_cover_begin(GNOMON_T(moment_fragment) nearest)
{
    GNOMON_T(fragment_cover) state;
    state.nearest = nearest;
    state.count = Real(0);
    state.far_depth = nearest.z;
    state.ends = Real(0);
    state.front = Real(1);
    return state;
}

/// One fragment, the nearest itself included. Nothing is made of NaN or of an id below 0.
GNOMON_KERNEL GNOMON_T(fragment_cover) fragment_cover_add(GNOMON_T(fragment_cover) state, GNOMON_T(moment_fragment) f)
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

/// The cover, or none.
GNOMON_KERNEL GNOMON_T(depth_time_range) fragment_cover_end(GNOMON_T(fragment_cover) state)
{
    GNOMON_MASK alone = state.count == Real(2) && state.far_depth <= state.front;
    GNOMON_MASK known = Real(0) <= state.nearest.id && Real(-1) <= state.nearest.z;
    GNOMON_MASK covers = known && Real(0) < state.ends && alone;
    GNOMON_T(moment_fragment) n = state.nearest;
    GNOMON_T(depth_time_range) cover = range_between(n.t, n.z, Real(1) - n.t, state.far_depth, n.id);
    return range_select(covers, cover, range_empty(Real(-1)));
}

/// The depth that covers must not be behind, 1.
GNOMON_KERNEL GNOMON_T(range_cover) range_cover_begin(Real far_plane)
{
    GNOMON_T(range_cover) state;
    state.best = range_empty(Real(-1));
    state.front = far_plane;
    state.far_plane = far_plane;
    return state;
}

/// One range, whole: a range is cut into pieces (moving_depth_piece) once it is known not to cover. The best of those
/// from 0 to 1 is that with the least farthest depth: if any of them is in front of all others, that one is. On a tie
/// that with the nearer end, then the lesser id. What is not the best counts among the others, whatever its id. A range
/// that shadows nothing, for its times are not in order or a depth is NaN, counts as none; a cover needs depths within
/// [-far_plane, far_plane] and an id from 0.
GNOMON_KERNEL GNOMON_T(range_cover) range_cover_add(GNOMON_T(range_cover) state, GNOMON_T(depth_time_range) r)
{
    Real near_depth = gnomon_min(r.z0, r.z1);
    Real far_depth = gnomon_max(r.z0, r.z1);
    Real best_near = gnomon_min(state.best.z0, state.best.z1);
    Real best_far = gnomon_max(state.best.z0, state.best.z1);
    GNOMON_MASK some = r.t0 <= r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    GNOMON_MASK within = gnomon_abs(r.z0) <= state.far_plane && gnomon_abs(r.z1) <= state.far_plane;
    GNOMON_MASK full = some && r.t0 <= Real(0) && Real(1) <= r.t1 && within && Real(0) <= r.id;
    GNOMON_MASK first = state.best.id < Real(0);
    GNOMON_MASK tie = far_depth == best_far;
    GNOMON_MASK tie_wins = near_depth < best_near || (near_depth == best_near && r.id < state.best.id);
    GNOMON_MASK better = full && (first || far_depth < best_far || (tie && tie_wins));

    Real other = gnomon_select(better, gnomon_select(first, state.far_plane, best_near), near_depth);
    state.front = gnomon_select(some && other < state.front, other, state.front);
    state.best = range_select(better, r, state.best);
    return state;
}

/// The cover, or none: whether the best was in front of all others, none of which is ever nearer than its farther end.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_cover_end(GNOMON_T(range_cover) state)
{
    GNOMON_MASK covers = gnomon_max(state.best.z0, state.best.z1) <= state.front;
    return range_select(covers, state.best, range_empty(Real(-1)));
}

/// 1 where a range may be left out of a list that keeps the cover: one that is never nearer than the cover's farther
/// end, or shadows nothing. At each time a receiver that is behind it is behind the cover, too, and shadowed by that,
/// whatever range_depth rounds: that is what the margin is for, which also keeps a level cover from hiding itself. So a
/// receiver gets the answer of all ranges, unless it has the cover's id and the cover is in front of it by more than
/// its bias: ids are for what range_list.h says. Domain: depths in [-1, 1], times in [0, 1].
GNOMON_KERNEL Real range_cover_hides(GNOMON_T(depth_time_range) cover, GNOMON_T(depth_time_range) r)
{
    GNOMON_MASK some = r.t0 <= r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    Real behind = gnomon_max(cover.z0, cover.z1) + GNOMON_LITERAL(cover_margin);
    GNOMON_MASK hidden = Real(0) <= cover.id && behind <= gnomon_min(r.z0, r.z1);
    return gnomon_select(hidden || !some, Real(1), Real(0));
}

/// The shadow test at time t and depth z on the surface with the given id; where it is decided, the answer of all
/// ranges that the cover is of, bit for bit. Shadowed where z is more than the bias behind the cover, whose own surface
/// is not shadowed by it; lit where z is within the bias, or less by 2^-19, of the cover's farther end, which nothing
/// else is in front of. In between, and without a cover, undecided. The paper asks no depth, and shadows a neighbouring
/// triangle that the shadow map's resolution puts into the cover's texel, in front of it. Domain: times in [0, 1],
/// depths in [-1, 1], bias in [0, 1].
GNOMON_KERNEL GNOMON_T(cover_answer)
    range_cover_answer(GNOMON_T(depth_time_range) cover, Real t, Real z, Real id, GNOMON_SETTING bias)
{
    GNOMON_T(cover_answer) r;
    r.intensity = range_intensity(cover, t, z, id, bias);
    Real behind = gnomon_max(cover.z0, cover.z1) + bias;
    GNOMON_MASK lit = z + GNOMON_LITERAL(cover_margin) <= behind;
    r.decided = gnomon_select(Real(0) <= cover.id && (lit || Real(0) < r.intensity), Real(1), Real(0));
    return r;
}

GNOMON_NAMESPACE_END
#endif
