// WGSL has neither preprocessor nor include guard: put this text, once, before the shader's own.
// The same bits as on the CPU come wherever / and sqrt are rounded correctly and no product is fused with a sum,
// neither of which WGSL can ask for (docs/shaders.md). Exact products stay whole in any case.

const gnomon_pivot_floor: f32 = 0x1p-30;

fn gnomon_select(mask: bool, a: f32, b: f32) -> f32 { return select(b, a, mask); }
fn gnomon_any(mask: bool) -> bool { return mask; }
fn gnomon_abs(a: f32) -> f32 { return abs(a); }
fn gnomon_sqrt(a: f32) -> f32 { return sqrt(a); }
// x, but nothing is fused, cancelled or reordered across a minimum of integers. Only bits of NaN are above this bound, which
// is one.
fn gnomon_kept(x: f32) -> f32 { return bitcast<f32>(min(bitcast<i32>(x), 0x7fc00000)); }
// x by another minimum, which hides one that is kept already.
fn gnomon_apart(x: f32) -> f32 { return bitcast<f32>(min(bitcast<u32>(x), 0xffc00000u)); }
fn gnomon_min(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a < b); }
fn gnomon_max(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a > b); }
fn gnomon_product(a: f32, b: f32) -> f32 { return gnomon_kept(a * b); }
fn gnomon_sum(a: f32, b: f32) -> f32 { return gnomon_kept(a + b); }
fn gnomon_difference(a: f32, b: f32) -> f32 { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
fn gnomon_saturate(x: f32) -> f32 {
    let bits = bitcast<i32>(x);
    return gnomon_select(bits > 0x7f800000, 0.0, bitcast<f32>(min(max(bits, 0), 0x3f800000)));
}
// a without the low half of its significand.
fn gnomon_high_part(a: f32) -> f32 { return bitcast<f32>(bitcast<u32>(a) & 0xfffff000u); }
// The sum has n in its low bits, and the shift moves n into the exponent.
fn gnomon_power_of_two(n: f32) -> f32 { return bitcast<f32>((bitcast<u32>(n + 12582912.0) << 23u) + 0x3f800000u); }
