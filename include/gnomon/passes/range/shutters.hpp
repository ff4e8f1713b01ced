// Shutters for look-ups in maps of ranges, and functions that add one range of a list as a shutter weights it. A
// shutter has two members. share(t, begin, end) returns the share of the light that it has let in by time t of an
// exposure from begin to end. filtered_light(state, hidden) returns the light that a moving receiver with filtering
// loses while `hidden` occludes it. The kernels are those of motion/receiver.
#ifndef GNOMON_PASSES_RANGE_SHUTTERS_HPP
#define GNOMON_PASSES_RANGE_SHUTTERS_HPP

#include "../../motion/receiver/moving_receiver.h"
#include "../../motion/receiver/static_receiver.h"
#include "../../portable/cpp_only.h"

#include <array>
#include <cstddef>

GNOMON_NAMESPACE_BEGIN

/// Opens and closes at once.
struct box_shutter {
    template <class T> GNOMON_INLINE constexpr T share(T t, T begin, T end) const { return shutter_box(t, begin, end); }
    template <class T>
    GNOMON_INLINE constexpr T filtered_light(const moving_receiver<T>& s, const depth_time_range<T>& hidden) const
    {
        return moving_receiver_filtered_light(s, hidden, s.begin, s.end, T(1), T(0));
    }
};

/// Opens and closes evenly, wide open halfway.
struct tent_shutter {
    template <class T> GNOMON_INLINE constexpr T share(T t, T begin, T end) const
    {
        return shutter_tent(t, begin, end);
    }
    template <class T>
    GNOMON_INLINE constexpr T filtered_light(const moving_receiver<T>& s, const depth_time_range<T>& hidden) const
    {
        const T halfway = shutter_time(s.begin, s.end, T(0.5));
        return moving_receiver_filtered_light(s, hidden, s.begin, halfway, T(0), T(4)) +
               moving_receiver_filtered_light(s, hidden, halfway, s.end, T(4), T(-4));
    }
};

/// Lets in the weights of shutter_weights_make, one in each eighth of the exposure.
template <class Real> struct piecewise_shutter {
    shutter_weights<Real> weights;

    GNOMON_INLINE constexpr Real share(Real t, Real begin, Real end) const
    {
        return shutter_piecewise(t, begin, end, weights);
    }
    GNOMON_INLINE constexpr Real filtered_light(const moving_receiver<Real>& s,
                                                const depth_time_range<Real>& hidden) const
    {
        const std::array<Real, 8> w{weights.w0, weights.w1, weights.w2, weights.w3,
                                    weights.w4, weights.w5, weights.w6, weights.w7};
        Real lost(0), start = s.begin;
        for (std::size_t k = 0; k < w.size(); ++k) {
            const Real share(static_cast<lane_t<Real>>(k + 1) / lane_t<Real>(8));
            const Real stop = k + 1 < w.size() ? shutter_time(s.begin, s.end, share) : s.end;
            const Real light = moving_receiver_filtered_light(s, hidden, start, stop, Real(8) * w[k], Real(0));
            lost = k == 0 ? light : lost + light;
            start = stop;
        }
        return lost;
    }
};

/// Opens and closes at once, for light that changes linearly from the weight open at the begin of the exposure to the
/// weight close at its end, as of shutter_line.
template <class Real> struct linear_shutter {
    Real open, close;

    GNOMON_INLINE constexpr Real share(Real t, Real begin, Real end) const
    {
        return shutter_line(t, begin, end, open, close);
    }
    GNOMON_INLINE constexpr Real filtered_light(const moving_receiver<Real>& s,
                                                const depth_time_range<Real>& hidden) const
    {
        const Real half =
            shutter_line(Real(0.5), Real(0), Real(1), open, close); // 1/2 + (open - close) / (open + close) / 4
        const Real slope = Real(4) - Real(8) * half;
        return moving_receiver_filtered_light(s, hidden, s.begin, s.end, Real(1) - Real(0.5) * slope, slope);
    }
};

/// Add a range of the current texel to a static receiver.
template <class T, class Shutter>
GNOMON_INLINE constexpr static_receiver<T> add_range(const static_receiver<T>& state, const depth_time_range<T>& r,
                                                     const Shutter& shutter)
{
    const depth_time_range<T> hidden = static_receiver_occluding_part(state, r);
    const T share0 = shutter.share(hidden.t0, state.begin, state.end);
    const T share1 = shutter.share(hidden.t1, state.begin, state.end);
    return static_receiver_add(state, receiver_lost_light(hidden, state.id, share0, share1));
}

/// Add a range of the current texel to a moving receiver without filtering.
template <class T, class Shutter>
GNOMON_INLINE constexpr moving_receiver<T> add_range(const moving_receiver<T>& state, const depth_time_range<T>& r,
                                                     const Shutter& shutter)
{
    const depth_time_range<T> hidden = moving_receiver_occluding_part(state, r);
    const T share0 = shutter.share(hidden.t0, state.begin, state.end);
    const T share1 = shutter.share(hidden.t1, state.begin, state.end);
    return moving_receiver_add(state, receiver_lost_light(hidden, state.depth.id, share0, share1));
}

/// Add a range of the current tap to a moving receiver with filtering.
template <class T, class Shutter>
GNOMON_INLINE constexpr moving_receiver<T> add_filtered_range(const moving_receiver<T>& state,
                                                              const depth_time_range<T>& r, const Shutter& shutter)
{
    return moving_receiver_add(state, shutter.filtered_light(state, moving_receiver_occluding_part(state, r)));
}

GNOMON_NAMESPACE_END
#endif
