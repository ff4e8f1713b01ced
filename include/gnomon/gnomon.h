// Everything in the kernel dialect, in the order in which data flows: depth -> moments -> storage format -> bounds ->
// intensity; then the comparators; then moving geometry. What is C++ only (.hpp: formats in memory, passes over maps,
// adapters, packs) is included by name.
#ifndef GNOMON_GNOMON_H
#define GNOMON_GNOMON_H
#include "moments/moments.h"

#include "moments/quantization.h"

#include "storage/moments4.h"
#include "storage/moments6.h"

#include "moments/certified4.h"
#include "storage/moments4_within.h"
#include "moments/hamburger4.h"
#include "moments/hamburger6.h"

#include "moments/bounds.h"
#include "moments/two_point.h"

#include "filters/convolution.h"
#include "filters/exponential.h"
#include "filters/exponential_variance.h"
#include "filters/layered_variance.h"
#include "filters/percentage_closer.h"
#include "filters/variance.h"

#include "motion/range/range_cover.h"
#include "motion/triangle/depth_planes.h"
#include "motion/triangle/triangle_setup.h"
#include "motion/triangle/edge_widening.h"
#include "motion/receiver/facing.h"
#include "motion/receiver/moving_receiver.h"
#include "motion/triangle/moving_triangle.h"
#include "motion/range/range.h"
#include "motion/range/range_list.h"
#include "motion/receiver/receiver_path.h"
#include "motion/receiver/shutter.h"
#include "motion/receiver/static_receiver.h"
#include "motion/receiver/texel_sweep.h"
#endif
