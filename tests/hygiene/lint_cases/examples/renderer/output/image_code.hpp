// expect: include goes up
#include "renderer/scene/camera.hpp"
