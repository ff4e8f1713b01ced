// The way of a receiver through the light's clip space while it is seen, and its shadow by samples in time (Palmer
// 2011, 2.3.2 and 4.1).
//
// Its point and the light move along straight lines, the light without turning, so x, y and w are linear in time and
// the point of the map is (x / w, y / w), a straight line as well; w is 1 for an orthographic light. Depth is linear in
// view distance, hence linear in time: depth and time are those of a range.
//
//     n = receiver_sample_count(path, most);
//     state = sampled_receiver_begin(n);
//     for k from 0 to n - 1: t = receiver_sample_time(path, k, n, jitter); of the texel at receiver_path_at(path, t),
//     the largest range_intensity(range, t, range_depth(path.depth, t), path.depth.id, bias) of all ranges, then
//         state = sampled_receiver_add(state, largest);     or the mean of several texels by their weights
//     intensity = sampled_receiver_end(state);
#ifndef GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#define GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#include "../../numerics/round.h"
#include "../range/range.h"
GNOMON_NAMESPACE_BEGIN

/// Times, depths and id as a range; x / w and y / w at time t0 and at time t1 in texels, centres at +0.5.
GNOMON_STRUCT(receiver_path)
{
    GNOMON_T(depth_time_range) depth;
    Real x0, y0, w0, x1, y1, w1;
};

/// In texels, centres at +0.5.
GNOMON_STRUCT(texel_position) { Real x, y; };

GNOMON_CONSTANT(receiver_sample_limit, 1048576.0); // 2^20

/// Where it is at time t, before and after its way at the nearer end. Domain: w > 0 at both ends. Error where w is 1:
/// 8 2^-p times the largest |x|; in perspective times (1 + the larger w over the smaller) as well.
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

/// The path beside it, so many texels further in x and in y.
GNOMON_KERNEL GNOMON_T(receiver_path) receiver_path_shift(GNOMON_T(receiver_path) path, Real dx, Real dy)
{
    path.x0 = path.x0 + dx * path.w0;
    path.y0 = path.y0 + dy * path.w0;
    path.x1 = path.x1 + dx * path.w1;
    path.y1 = path.y1 + dy * path.w1;
    return path;
}

/// What of it falls between two times, such as those at which it faces the light (facing.h).
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

/// How long it is on the map, in texels. Domain: w > 0 at both ends. Error: 4 2^-p times the largest |x| + |y|.
GNOMON_KERNEL Real receiver_path_length(GNOMON_T(receiver_path) path)
{
    Real dx = path.x1 / path.w1 - path.x0 / path.w0;
    Real dy = path.y1 / path.w1 - path.y0 / path.w0;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// How many samples to take of it: max(2 length, 5) (Palmer 2011, 4.1), rounded up, and no more than most. A whole
/// number; most is a whole number from 5 to 2^20, and what is outside of that counts as the nearer end, NaN as 5.
GNOMON_KERNEL Real receiver_sample_count(GNOMON_T(receiver_path) path, GNOMON_SETTING most)
{
    Real wanted = gnomon_max(Real(2) * receiver_path_length(path), Real(5)); // a NaN becomes 5
    Real limit = gnomon_min(gnomon_max(most, Real(5)), GNOMON_LITERAL(receiver_sample_limit));
    Real count = gnomon_min(wanted, limit);
    Real whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, Real(1), Real(0));
}

/// The time of sample k of n, k from 0: stratified, at jitter in [0, 1) of its n-th of the time; 0.5 is the middle.
GNOMON_KERNEL Real receiver_sample_time(GNOMON_T(receiver_path) path, Real k, Real n, Real jitter)
{
    Real passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0 * (Real(1) - passed) + path.depth.t1 * passed;
}

/// The number of samples, and how many of them were in shadow so far.
GNOMON_STRUCT(sampled_receiver) { Real samples, shadowed; };

/// No sample yet of so many.
GNOMON_KERNEL GNOMON_T(sampled_receiver) sampled_receiver_begin(Real samples)
{
    GNOMON_T(sampled_receiver) r;
    r.samples = samples;
    r.shadowed = Real(0);
    return r;
}

/// One sample with its shadow intensity in [0, 1]; NaN is lit.
GNOMON_KERNEL GNOMON_T(sampled_receiver) sampled_receiver_add(GNOMON_T(sampled_receiver) state, Real intensity)
{
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean. An error of sampling remains: up to 1 / n of n samples for each time at which
/// the shadow comes or goes, half of that with samples in the middle.
GNOMON_KERNEL Real sampled_receiver_end(GNOMON_T(sampled_receiver) state)
{
    return saturate_or_zero(state.shadowed / state.samples);
}

GNOMON_NAMESPACE_END
#endif
