#include "gnomon.glsl"
#include "method.h"
