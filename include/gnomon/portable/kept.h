// Functions of the languages in which a kernel is no template, by gnomon_kept. No compiler may fuse, cancel or reorder
// their results, with or without the word precise: translators of SPIR-V drop it, and fast mathematics ignores it.
#ifndef GNOMON_PORTABLE_KEPT_H
#define GNOMON_PORTABLE_KEPT_H

// A compiler that knew both operands would write min() and max(), which lose a NaN.
GNOMON_KERNEL Real gnomon_min(Real a, Real b) { return gnomon_select(a < b, a, gnomon_kept(b)); }
GNOMON_KERNEL Real gnomon_max(Real a, Real b) { return gnomon_select(b < a, a, gnomon_kept(b)); }
GNOMON_KERNEL Real gnomon_product(Real a, Real b) { return gnomon_kept(a * b); }
GNOMON_KERNEL Real gnomon_sum(Real a, Real b) { return gnomon_kept(a + b); }
GNOMON_KERNEL Real gnomon_difference(Real a, Real b) { return gnomon_kept(a - b); }

#endif
