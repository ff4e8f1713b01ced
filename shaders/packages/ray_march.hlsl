// Gnomon 0.1.0, ray_march.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RAY_MARCH_HLSL
#define GNOMON_RAY_MARCH_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: ray_march.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: ray_march.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: ray_march.hlsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

static const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return asfloat(min(asint(x), 0x7FC00000)); }
float gnomon_apart(float x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, 0.0, asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return asfloat((asuint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// comparators/ray_march.h ---------------------------------------------------------------------------------------------
// Single scattering by ray marching through a shadow map (Toth & Umenhoffer 2009), with which prefiltered single
// scattering (Peters et al. 2017, Sec. 5) is compared: the view ray is cut into steps of equal length, and each step
// looks up the map once.
//
//     march = ray_march_begin(transmittance);                   of one step, exp(-sigma_t Delta)
//     march = ray_march_add(march, z, z_f);                     for every step, from the camera on
//     intensity = ray_march_end(march);
//
// Step k is looked up at (k + jitter) Delta, where z is the depth of the map there and z_f that of the ray. A jitter
// that differs between neighbouring pixels makes noise of what would be bands: ray_march_jitter.
//
// Light scattered in step k is proportional to what the air transmits on the way from its begin, and a factor that all
// steps share cancels in the mean. So the weights are exact, for any extinction; the sample within a step is not.
#ifndef GNOMON_COMPARATORS_RAY_MARCH_H
#define GNOMON_COMPARATORS_RAY_MARCH_H

/// The weight in shadow so far, that of all steps so far, the transmittance up to the next step, and that of one step.
struct ray_march { float shadowed, weight, transmittance, step; };

/// The state before the first step.
/// Domain: any transmittance of one step, limited to [0, 1].
/// NaN: 1, clear air.
ray_march ray_march_begin(float step_transmittance)
{
    ray_march r;
    r.shadowed = 0.0;
    r.weight = 0.0;
    r.transmittance = 1.0;
    r.step = clamp_or_high(step_transmittance, 0.0, 1.0);
    return r;
}

/// The state after one more step, at depth z_f, where the shadow map has depth z.
/// Domain: any depths.
/// NaN: lit, for either.
ray_march ray_march_add(ray_march state, float z, float z_f)
{
    state.shadowed = state.shadowed + gnomon_select(z < z_f, state.transmittance, 0.0);
    state.weight = state.weight + state.transmittance;
    state.transmittance = state.transmittance * state.step;
    return state;
}

/// Shadow intensity of the ray in [0, 1]: the part of the light scattered towards the camera that the shadow takes
/// away.
/// NaN: 0, lit; so before the first step.
/// Error: of n steps, 3 n 2^-p, for sums in the precision of p bits.
/// Source: Peters 2017, Sec. 5.5.1; Toth & Umenhoffer 2009
float ray_march_end(ray_march state) { return saturate_or_zero(state.shadowed / state.weight); }

static const float ray_march_jitter_x = 0.06711056;
static const float ray_march_jitter_y = 0.00583715;
static const float ray_march_jitter_scale = 52.9829189;

/// x - floor(x), in [0, 1).
/// Domain: |x| <= 2^21.
float gnomon_ray_march_fraction(float x)
{
    float fraction = x - nearest_integer(x - 0.5);
    return gnomon_select(0.0 <= fraction && fraction < 1.0, fraction, 0.0); // also where nothing is rounded
}

/// A number in [0, 1) for the pixel at column x and row y: interleaved gradient noise, of which the values of 3 x 3
/// pixels lie evenly in [0, 1), so that a small blur removes what it leaves.
/// Domain: whole numbers, limited to [0, 65536].
/// NaN: that of column or row 65536.
/// Source: Jimenez 2014
float ray_march_jitter(float x, float y)
{
    float column = clamp_or_high(x, 0.0, 65536.0);
    float row = clamp_or_high(y, 0.0, 65536.0);
    float inner = gnomon_ray_march_fraction(ray_march_jitter_x * column + ray_march_jitter_y * row);
    return gnomon_ray_march_fraction(ray_march_jitter_scale * inner);
}

#endif

#endif
