// The texels that a moving receiver passes, in order, and from when to when it is in each (what Palmer 2011, chapter 5,
// asks of analytical dynamic receivers; the traversal is that of Amanatides & Woo 1987, in time and in perspective).
//
// The texel border x = c is met where x(t) - c w(t) = 0, linear in time also in perspective, at the share
//     s = (x0 - c w0) / ((x0 - c w0) - (x1 - c w1))
// of the way. While w > 0, x / w goes one way, so the borders between the first and the last column are met one after
// the other, and so are those of rows: the earlier of the next two is the next step. Texels come from counting steps,
// times from the borders, and where rounding has times meet they come in either order, one of them for no time.
//
//     sweep = texel_sweep_begin(path);
//     for each range of texel (sweep.column, sweep.row): what holds from sweep.t_begin to sweep.t_end
//     while (sweep.t_end < sweep.path.depth.t1) { sweep = texel_sweep_next(sweep); and the same again }
//
// Whatever the path is, the times follow one another bit for bit from t0 to t1, and the loop ends: after |last column -
// first column| + |last row - first row| + 1 texels at most.
#ifndef GNOMON_MOTION_TEXEL_SWEEP_H
#define GNOMON_MOTION_TEXEL_SWEEP_H
#include "receiver_path.h"
GNOMON_NAMESPACE_BEGIN

/// The texel, from when to when, the texel of the path's end, and where on the way the next borders are met.
GNOMON_STRUCT texel_sweep
{
    GNOMON_T(receiver_path) path;
    Real column, row, t_begin, t_end, last_column, last_row, across_column, across_row;
};

GNOMON_CONSTANT(texel_limit, 65536.0);                    // no map is larger: what is beyond is one texel
GNOMON_CONSTANT(texel_path_limit, 1152921504606846976.0); // 2^60: positions that are numbers
GNOMON_CONSTANT(texel_border_none, 2.0);                  // after the way has ended

/// The texel that a position is in, the largest whole number up to it, limited to +-65536; 65536 for NaN.
GNOMON_KERNEL Real texel_below(Real x)
{
    Real limit = GNOMON_LITERAL(texel_limit);
    Real inside = gnomon_max(gnomon_min(x, limit), Real(-1) * limit);
    Real whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, Real(1), Real(0));
}

/// The share of the way, in [0, 1], at which one coordinate leaves a texel towards the last one; 2 in the last one.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
GNOMON_KERNEL Real texel_border_passed(Real x0, Real w0, Real x1, Real w1, Real texel, Real last)
{
    Real border = texel + gnomon_select(texel < last, Real(1), Real(0));
    Real distance0 = x0 - gnomon_product(border, w0);
    Real distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, GNOMON_LITERAL(texel_border_none),
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// Ends the texel's time at the next border, or with the path.
GNOMON_KERNEL GNOMON_T(texel_sweep) texel_sweep_timed(GNOMON_T(texel_sweep) sweep)
{
    Real passed = gnomon_min(sweep.across_column, sweep.across_row);
    Real t = sweep.path.depth.t0 * (Real(1) - passed) + sweep.path.depth.t1 * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.path.depth.t1); // never back; what is NaN takes no time
    sweep.t_end = gnomon_select(passed <= Real(1), t, sweep.path.depth.t1);
    return sweep;
}

/// The first texel. A path with a NaN, with positions beyond 2^60 or with w <= 0 at an end is in one texel for all its
/// time: that of its first end, or (65536, 65536), off every map, where that is unknown, too. So is one whose times are
/// not in order.
GNOMON_KERNEL GNOMON_T(texel_sweep) texel_sweep_begin(GNOMON_T(receiver_path) path)
{
    Real x0 = path.x0 / path.w0;
    Real y0 = path.y0 / path.w0;
    Real x1 = path.x1 / path.w1;
    Real y1 = path.y1 / path.w1;
    Real size = (gnomon_abs(x0) + gnomon_abs(y0)) + (gnomon_abs(x1) + gnomon_abs(y1));
    GNOMON_MASK known = Real(0) < path.w0 && Real(0) < path.w1 && size < GNOMON_LITERAL(texel_path_limit);
    GNOMON_T(texel_sweep) sweep;
    sweep.path = path;
    sweep.column = texel_below(x0);
    sweep.row = texel_below(y0);
    sweep.t_begin = path.depth.t0;
    sweep.t_end = path.depth.t1;
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.across_column = texel_border_passed(path.x0, path.w0, path.x1, path.w1, sweep.column, sweep.last_column);
    sweep.across_row = texel_border_passed(path.y0, path.w0, path.y1, path.w1, sweep.row, sweep.last_row);
    return texel_sweep_timed(sweep);
}

/// The next texel, beside, above or below; after the last one the same again, for no time.
GNOMON_KERNEL GNOMON_T(texel_sweep) texel_sweep_next(GNOMON_T(texel_sweep) sweep)
{
    GNOMON_MASK sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= Real(1);
    GNOMON_MASK along = sweep.across_row < sweep.across_column && sweep.across_row <= Real(1);
    Real step_column = gnomon_select(sweep.column < sweep.last_column, Real(1), Real(-1));
    Real step_row = gnomon_select(sweep.row < sweep.last_row, Real(1), Real(-1));
    sweep.column = sweep.column + gnomon_select(sideways, step_column, Real(0));
    sweep.row = sweep.row + gnomon_select(along, step_row, Real(0));
    // Only what has stepped has a new border.
    Real x0 = gnomon_select(sideways, sweep.path.x0, sweep.path.y0);
    Real x1 = gnomon_select(sideways, sweep.path.x1, sweep.path.y1);
    Real texel = gnomon_select(sideways, sweep.column, sweep.row);
    Real last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    Real passed = texel_border_passed(x0, sweep.path.w0, x1, sweep.path.w1, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return texel_sweep_timed(sweep);
}

GNOMON_NAMESPACE_END
#endif
