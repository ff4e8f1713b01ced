// The path of a receiver through the light's clip space while a pixel sees it, and its shadow by samples in time
// (Palmer 2011, 2.3.2 and 4.1).
//
// The receiver's point and the light move along straight lines, and the light does not turn, so x, y and w are linear
// in time. The point on the map, (x / w, y / w), moves along a straight line, too; w is 1 for an orthographic light.
// Depth is linear in view distance, hence linear in time: depth and time are those of a range.
//
//     n = receiver_sample_count(path, most);
//     state = sampled_receiver_begin(n);
//     for k from 0 to n - 1: t = receiver_sample_time(path, k, n, jitter); in the texel at receiver_path_at(path, t),
//     the largest range_intensity(range, t, range_depth(path.depth, t), path.depth.id, bias) of all ranges, then
//         state = sampled_receiver_add(state, largest);     or the mean of several texels by their weights
//     intensity = sampled_receiver_end(state);
#ifndef GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#define GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#include "../../numerics/round.h"
#include "../range/range.h"
GNOMON_NAMESPACE_BEGIN

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
GNOMON_STRUCT(receiver_path)
{
    GNOMON_T(depth_time_range) depth;
    Real x0, y0, w0, x1, y1, w1;
};

/// A position in texels, texel centres at +0.5.
GNOMON_STRUCT(texel_position) { Real x, y; };

GNOMON_CONSTANT(receiver_sample_limit, 1048576.0); // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
GNOMON_KERNEL GNOMON_T(texel_position) receiver_path_at(GNOMON_T(receiver_path) path, Real t)
{
    Real passed = range_elapsed(path.depth, t);
    Real left = Real(1) - passed;
    Real w = path.w0 * left + path.w1 * passed;
    GNOMON_T(texel_position) r;
    r.x = (path.x0 * left + path.x1 * passed) / w;
    r.y = (path.y0 * left + path.y1 * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
GNOMON_KERNEL GNOMON_T(receiver_path) receiver_path_shift(GNOMON_T(receiver_path) path, Real dx, Real dy)
{
    path.x0 = path.x0 + dx * path.w0;
    path.y0 = path.y0 + dy * path.w0;
    path.x1 = path.x1 + dx * path.w1;
    path.y1 = path.y1 + dy * path.w1;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
GNOMON_KERNEL GNOMON_T(receiver_path) receiver_path_clip(GNOMON_T(receiver_path) path, Real begin, Real end)
{
    Real passed0 = range_elapsed(path.depth, begin);
    Real passed1 = range_elapsed(path.depth, end);
    Real left0 = Real(1) - passed0;
    Real left1 = Real(1) - passed1;
    GNOMON_T(receiver_path) c;
    c.depth = range_clip(path.depth, begin, end);
    c.x0 = path.x0 * left0 + path.x1 * passed0;
    c.y0 = path.y0 * left0 + path.y1 * passed0;
    c.w0 = path.w0 * left0 + path.w1 * passed0;
    c.x1 = path.x0 * left1 + path.x1 * passed1;
    c.y1 = path.y0 * left1 + path.y1 * passed1;
    c.w1 = path.w0 * left1 + path.w1 * passed1;
    return c;
}

/// Length of the path on the map, in texels.
/// Domain: w > 0 at both ends.
/// Error: 4 2^-p times the largest |x| + |y|.
GNOMON_KERNEL Real receiver_path_length(GNOMON_T(receiver_path) path)
{
    Real dx = path.x1 / path.w1 - path.x0 / path.w0;
    Real dy = path.y1 / path.w1 - path.y0 / path.w0;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
GNOMON_KERNEL Real receiver_sample_count(GNOMON_T(receiver_path) path, GNOMON_SETTING most)
{
    Real wanted = gnomon_max(Real(2) * receiver_path_length(path), Real(5)); // a NaN becomes 5
    Real limit = gnomon_min(gnomon_max(most, Real(5)), GNOMON_LITERAL(receiver_sample_limit));
    Real count = gnomon_min(wanted, limit);
    Real whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, Real(1), Real(0));
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
GNOMON_KERNEL Real receiver_sample_time(GNOMON_T(receiver_path) path, Real k, Real n, Real jitter)
{
    Real passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0 * (Real(1) - passed) + path.depth.t1 * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
GNOMON_STRUCT(sampled_receiver) { Real samples, shadowed; };

/// Begin with the number of samples to come.
GNOMON_KERNEL GNOMON_T(sampled_receiver) sampled_receiver_begin(Real samples)
{
    GNOMON_T(sampled_receiver) r;
    r.samples = samples;
    r.shadowed = Real(0);
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
GNOMON_KERNEL GNOMON_T(sampled_receiver) sampled_receiver_add(GNOMON_T(sampled_receiver) state, Real intensity)
{
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
GNOMON_KERNEL Real sampled_receiver_end(GNOMON_T(sampled_receiver) state)
{
    return saturate_or_zero(state.shadowed / state.samples);
}

GNOMON_NAMESPACE_END
#endif
