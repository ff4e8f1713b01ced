#include "gnomon.glsl"
layout(constant_id = 0) const int method = 0;
layout(constant_id = 1) const int images = 1;
layout(constant_id = 2) const float setting0 = 0;
layout(constant_id = 3) const float setting1 = 0;
layout(constant_id = 4) const float setting2 = 0;
#include "method.h"
