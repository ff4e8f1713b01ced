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

#include "motion/coverage_map.h"
#include "motion/depth_planes.h"
#include "motion/edge_field.h"
#include "motion/edge_widening.h"
#include "motion/facing.h"
#include "motion/moving_receiver.h"
#include "motion/moving_triangle.h"
#include "motion/prism.h"
#include "motion/range.h"
#include "motion/range_list.h"
#include "motion/receiver_path.h"
#include "motion/shutter.h"
#include "motion/static_receiver.h"
#include "motion/texel_sweep.h"
#endif
