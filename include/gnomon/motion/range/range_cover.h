// Texels that one surface covers for the whole shutter, in front of everything else: the coverage map of Hong & Oh
// ("Efficient motion blurred shadows using a temporal shadow map", 2017). All other ranges of such a texel are hidden
// at all times and need not be stored. A cover is a range from 0 to 1 with the id of its surface. Where there is no
// cover, the range is empty and has the id -1.
//
// The paper needs three passes (comparators/three_pass_cover.h) and leaves one pass for future work. This text takes
// one pass over ranges, in any order:
//
//     state = range_cover_begin(1);              state = range_cover_add(state, r);            for all r
//     cover = range_cover_end(state);
//
// Ranges for which range_cover_occludes returns 1 may be left out of the list. The cover stays in the list or stands for
// it:
//
//     answer = range_cover_answer(cover, t, z, id, bias);   the list is asked where answer.decided is 0
#ifndef GNOMON_MOTION_RANGE_RANGE_COVER_H
#define GNOMON_MOTION_RANGE_RANGE_COVER_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// The best cover so far, and the nearest depth of all others.
GNOMON_STRUCT(range_cover)
{
    GNOMON_T(depth_time_range) best;
    Real front, far_plane;
};

/// What a cover says of a receiver: shadow intensity, 0 or 1, and whether that is all (1) or the list has to be asked.
GNOMON_STRUCT(cover_answer) { Real intensity, decided; };

GNOMON_CONSTANT(cover_margin, 0.0000019073486328125); // 2^-19, 32 2^-p in float

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
GNOMON_KERNEL Real range_cover_occludes(GNOMON_T(depth_time_range) cover, GNOMON_T(depth_time_range) r)
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
GNOMON_KERNEL GNOMON_T(cover_answer) range_cover_answer(GNOMON_T(depth_time_range) cover, Real t, Real z, Real id,
                                                        GNOMON_SETTING bias)
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
