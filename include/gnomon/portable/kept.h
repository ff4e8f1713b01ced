// Functions of the languages in which a kernel is no template, by gnomon_kept. No compiler may fuse, cancel or reorder
// their results, with or without the word precise: translators of SPIR-V drop it, and fast mathematics ignores it.
#ifndef GNOMON_PORTABLE_KEPT_H
#define GNOMON_PORTABLE_KEPT_H

// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
GNOMON_KERNEL Real gnomon_min(Real a, Real b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
GNOMON_KERNEL Real gnomon_max(Real a, Real b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
GNOMON_KERNEL Real gnomon_product(Real a, Real b) { return gnomon_kept(a * b); }
GNOMON_KERNEL Real gnomon_sum(Real a, Real b) { return gnomon_kept(a + b); }
GNOMON_KERNEL Real gnomon_difference(Real a, Real b) { return gnomon_kept(a - b); }

#endif
