// The texels that a moving receiver passes, in order, and the time that it spends in each (for the analytical dynamic
// receivers that Palmer 2011, chapter 5, leaves as future work; the traversal is that of Amanatides & Woo 1987, in time
// and in perspective).
//
// The path crosses the texel border x = c where x(t) - c w(t) = 0, which is linear in time, also in perspective. The
// share of the path's time at the crossing is
//     s = (x0 - c w0) / ((x0 - c w0) - (x1 - c w1))
// While w > 0, x / w is monotonic, so the path crosses the borders between its first and its last column one after the
// other, and those of rows alike. The earlier of the next two crossings is the next step. Texels come from counting
// steps, times from the borders. Where rounding makes two times equal, their steps come in either order, and the texel
// between them lasts no time.
//
//     sweep = texel_sweep_begin(path);
//     for each range of texel (sweep.column, sweep.row): use the part from sweep.t_begin to sweep.t_end
//     while (sweep.t_end < sweep.t_last) { sweep = texel_sweep_next(sweep); and the same again }
//
// For any path the times are contiguous from t0 to t1, bit for bit, and the loop ends after at most |last column -
// first column| + |last row - first row| + 1 texels.
//
// texel_sweep_over leaves out the parts of the path that are beside the map or behind the light. In homogeneous
// coordinates the map's borders are edges that the path crosses at one time each, also where w changes its sign.
#ifndef GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H
#define GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H
#include "../../numerics/texel_filter.h"
#include "../triangle/coverage_intervals.h"
#include "receiver_path.h"
GNOMON_NAMESPACE_BEGIN

/// The current texel and the times at which the path enters and leaves it; the last texel and the time at which the
/// sweep ends; the shares of the path's time at which it crosses the next borders.
GNOMON_STRUCT(texel_sweep)
{
    GNOMON_T(receiver_path) path;
    Real column, row, t_begin, t_end, last_column, last_row, t_last, across_column, across_row;
};

GNOMON_CONSTANT(texel_path_limit, 1152921504606846976.0); // 2^60: positions that are numbers
GNOMON_CONSTANT(texel_border_none, 2.0);                  // after the end of the path

/// Share of the path's time, in [0, 1], at which one coordinate leaves a texel towards the last texel; 2 in the last
/// texel.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
GNOMON_DETAIL_KERNEL Real texel_border_share(Real x0, Real w0, Real x1, Real w1, Real texel, Real last)
{
    Real border = texel + gnomon_select(texel < last, Real(1), Real(0));
    Real distance0 = x0 - gnomon_product(border, w0);
    Real distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, GNOMON_LITERAL(texel_border_none),
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// End the texel's time at the next border, or at the end of the sweep.
GNOMON_DETAIL_KERNEL GNOMON_T(texel_sweep) texel_sweep_set_times(GNOMON_T(texel_sweep) sweep)
{
    Real passed = gnomon_min(sweep.across_column, sweep.across_row);
    Real t = sweep.path.depth.t0 * (Real(1) - passed) + sweep.path.depth.t1 * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.t_last); // never back; a NaN lasts no time
    sweep.t_end = gnomon_select(passed <= Real(1), t, sweep.t_last);
    return sweep;
}

/// Find the first crossings of borders.
GNOMON_DETAIL_KERNEL GNOMON_T(texel_sweep) texel_sweep_start(GNOMON_T(texel_sweep) sweep)
{
    receiver_path p = sweep.path;
    sweep.across_column = texel_border_share(p.x0, p.w0, p.x1, p.w1, sweep.column, sweep.last_column);
    sweep.across_row = texel_border_share(p.y0, p.w0, p.y1, p.w1, sweep.row, sweep.last_row);
    return texel_sweep_set_times(sweep);
}

/// The first texel of a path, for the whole of its time.
/// Domain: for positions beyond 2^60, w <= 0 at an end, or times out of order, the sweep has one texel for the whole
/// time: that of the path's first end, or (65536, 65536), off every map, if that position is unknown, too.
/// NaN: as outside of the domain.
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
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.t_last = path.depth.t1;
    return texel_sweep_start(sweep);
}

/// Shares of the path's time, in [0, 1], at which the path is over the texels from (left, top) to before (right,
/// bottom), and w >= 0.
/// Domain: empty for positions that differ by 2^60 or more.
/// NaN: empty.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, for the border x = c
/// that is crossed; rows alike.
GNOMON_DETAIL_KERNEL GNOMON_T(linear_interval) receiver_path_over(GNOMON_T(receiver_path) p, Real left, Real top,
                                                                  Real right, Real bottom)
{
    linear_interval a = linear_edge_inside(p.x0 - gnomon_product(left, p.w0), p.x1 - gnomon_product(left, p.w1));
    linear_interval b = linear_edge_inside(p.y0 - gnomon_product(top, p.w0), p.y1 - gnomon_product(top, p.w1));
    linear_interval c = linear_edge_inside(gnomon_product(right, p.w0) - p.x0, gnomon_product(right, p.w1) - p.x1);
    linear_interval d = linear_edge_inside(gnomon_product(bottom, p.w0) - p.y0, gnomon_product(bottom, p.w1) - p.y1);
    linear_interval before_light = linear_edge_inside(p.w0, p.w1);
    a.begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), gnomon_max(c.begin, d.begin)), before_light.begin);
    a.end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), gnomon_min(c.end, d.end)), before_light.end);
    return a;
}

/// Column or row of a position, limited to low - 1, before the first, and high, after the last.
GNOMON_DETAIL_KERNEL Real texel_clamp(Real x, Real low, Real high)
{
    return gnomon_min(gnomon_max(texel_below(x), low - Real(1)), high);
}

/// The first of the texels from (left, top) to before (right, bottom) that the path is over; (right, bottom) for no
/// time if there is none. The times are those of texel_sweep_begin for these texels. If w <= 0 at one end, the sweep
/// covers the time at which w > 0.
/// Domain: borders are whole numbers within +-65536.
GNOMON_KERNEL GNOMON_T(texel_sweep) texel_sweep_over(GNOMON_T(receiver_path) path, Real left, Real top, Real right,
                                                     Real bottom)
{
    linear_interval shares = receiver_path_over(path, left, top, right, bottom);
    GNOMON_MASK some = shares.begin < shares.end;
    Real passed0 = gnomon_select(some, shares.begin, Real(0));
    Real passed1 = gnomon_select(some, shares.end, Real(0));
    Real left0 = Real(1) - passed0;
    Real left1 = Real(1) - passed1;
    Real w0 = path.w0 * left0 + path.w1 * passed0;
    Real w1 = path.w0 * left1 + path.w1 * passed1;
    GNOMON_T(texel_sweep) sweep;
    sweep.path = path;
    sweep.column = texel_clamp((path.x0 * left0 + path.x1 * passed0) / w0, left, right);
    sweep.row = texel_clamp((path.y0 * left0 + path.y1 * passed0) / w0, top, bottom);
    sweep.last_column = texel_clamp((path.x0 * left1 + path.x1 * passed1) / w1, left, right);
    sweep.last_row = texel_clamp((path.y0 * left1 + path.y1 * passed1) / w1, top, bottom);
    sweep.column = gnomon_select(some, sweep.column, right);
    sweep.row = gnomon_select(some, sweep.row, bottom);
    sweep.last_column = gnomon_select(some, sweep.last_column, right);
    sweep.last_row = gnomon_select(some, sweep.last_row, bottom);
    sweep.t_begin = path.depth.t0 * left0 + path.depth.t1 * passed0;
    sweep.t_last = path.depth.t0 * left1 + path.depth.t1 * passed1;
    return texel_sweep_start(sweep);
}

/// The next texel: a neighbour along either axis. After the last texel that texel again, for no time.
/// Source: Amanatides & Woo 1987
GNOMON_KERNEL GNOMON_T(texel_sweep) texel_sweep_next(GNOMON_T(texel_sweep) sweep)
{
    GNOMON_MASK sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= Real(1);
    GNOMON_MASK along = sweep.across_row < sweep.across_column && sweep.across_row <= Real(1);
    Real step_column = gnomon_select(sweep.column < sweep.last_column, Real(1), Real(-1));
    Real step_row = gnomon_select(sweep.row < sweep.last_row, Real(1), Real(-1));
    sweep.column = sweep.column + gnomon_select(sideways, step_column, Real(0));
    sweep.row = sweep.row + gnomon_select(along, step_row, Real(0));
    // Only the axis that stepped has a new border.
    Real x0 = gnomon_select(sideways, sweep.path.x0, sweep.path.y0);
    Real x1 = gnomon_select(sideways, sweep.path.x1, sweep.path.y1);
    Real texel = gnomon_select(sideways, sweep.column, sweep.row);
    Real last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    Real passed = texel_border_share(x0, sweep.path.w0, x1, sweep.path.w1, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return texel_sweep_set_times(sweep);
}

GNOMON_NAMESPACE_END
#endif
