// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_STRUCT(channels1) { Real c1; };

GNOMON_STRUCT(channels2) { Real c1, c2; };

GNOMON_STRUCT(channels4) { Real c1, c2, c3, c4; };

GNOMON_STRUCT(channels5) { Real c1, c2, c3, c4, c5; };

GNOMON_STRUCT(channels6) { Real c1, c2, c3, c4, c5, c6; };

GNOMON_NAMESPACE_END
#endif
