// Texels that one surface covers for the whole shutter, in front of everything else: the coverage map of Hong & Oh
// ("Efficient motion blurred shadows using a temporal shadow map", 2017). All other ranges of such a texel are occluded
// at all times and need not be stored. A cover is a range from 0 to 1 with the id of its surface. A texel without a
// cover has an empty range with the id -1.
//
// The paper needs three passes (comparators/three_pass_cover.h) and leaves a single pass for future work. These kernels
// take one pass over ranges, in any order:
//
//     state = range_cover_begin(1);              state = range_cover_add(state, r);            for all r
//     cover = range_cover_end(state);
//
// Ranges for which range_cover_occludes returns 1 may be left out of the list. The cover stays in the list, or a
// look-up tests it first:
//
//     answer = range_cover_answer(cover, t, z, id, bias);   if answer.decided is 0, test the list
#ifndef GNOMON_MOTION_RANGE_RANGE_COVER_H
#define GNOMON_MOTION_RANGE_RANGE_COVER_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// The best cover so far, and the nearest depth of all other ranges.
GNOMON_STRUCT(range_cover)
{
    GNOMON_T(depth_time_range) best;
    Real front, far_plane;
};

/// The answer of a cover for one receiver: shadow intensity, 0 or 1, and decided, which is 1 if that is the answer of
/// the whole texel and 0 if the list has to be tested.
GNOMON_STRUCT(cover_answer) { Real intensity, decided; };

GNOMON_CONSTANT(cover_margin, 0.0000019073486328125); // 2^-19, 32 2^-p in float

/// Begin without a range. Covers must not lie behind far_plane, which is 1.
GNOMON_KERNEL GNOMON_T(range_cover) range_cover_begin(Real far_plane)
{
    GNOMON_T(range_cover) state;
    state.best = range_empty(Real(-1));
    state.front = far_plane;
    state.far_plane = far_plane;
    return state;
}

/// Add one range, as a whole: cut it into pieces (moving_depth_piece) only after it is known not to be the cover. The
/// best of the ranges from 0 to 1 is the one with the least farthest depth; if any range is in front of all others,
/// this one is. Ties go to the nearer end, then to the lesser id. All other ranges count as others, whatever their ids.
/// A range whose times are out of order adds nothing.
/// Domain: a cover needs depths within [-far_plane, far_plane] and an id of at least 0.
/// NaN: a range with a NaN adds nothing.
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

/// The cover, or an empty range with the id -1: the best range if no other one is ever nearer than its farther end.
/// Source: Hong & Oh 2017
GNOMON_KERNEL GNOMON_T(depth_time_range) range_cover_end(GNOMON_T(range_cover) state)
{
    GNOMON_MASK covers = gnomon_max(state.best.z0, state.best.z1) <= state.front;
    return range_select(covers, state.best, range_empty(Real(-1)));
}

/// 1 where r may be left out of a list that keeps the cover: r is never nearer than the cover's farther end, or shadows
/// nothing. A receiver behind r is then behind the cover at all times, and shadowed by the cover, in spite of the
/// rounding of range_depth: the margin outweighs that rounding, and keeps a level cover from occluding itself. So a
/// receiver gets the answer of all ranges, unless it has the cover's id and the cover is in front of it by more than
/// its bias (see range_list.h for ids).
/// Domain: depths in [-1, 1], times in [0, 1].
GNOMON_KERNEL Real range_cover_occludes(GNOMON_T(depth_time_range) cover, GNOMON_T(depth_time_range) r)
{
    GNOMON_MASK some = r.t0 <= r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    Real behind = gnomon_max(cover.z0, cover.z1) + GNOMON_LITERAL(cover_margin);
    GNOMON_MASK hidden = Real(0) <= cover.id && behind <= gnomon_min(r.z0, r.z1);
    return gnomon_select(hidden || !some, Real(1), Real(0));
}

/// Shadow test at time t and depth z on the surface with the given id. Where decided, the answer is that of all ranges
/// of the texel, bit for bit. The receiver is shadowed where z is more than the bias behind the cover and the cover has
/// another id. The receiver is lit where z is within the bias, less 2^-19, of the cover's farther end, since nothing
/// else is in front of the cover. Between the two, and without a cover, the answer is undecided. The paper compares no
/// depths: its test shadows a neighbouring triangle that lies in front of the cover, but falls into the cover's texel
/// by the map's resolution.
/// Domain: times in [0, 1], depths in [-1, 1], bias in [0, 1].
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
