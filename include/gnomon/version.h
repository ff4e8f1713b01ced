// The version, in its one place: CMake and shaders/package.py read it here. #if GNOMON_VERSION >= 100 may be written in every
// language; in a shader package the number is GNOMON_PACKAGE.
#ifndef GNOMON_VERSION_H
#define GNOMON_VERSION_H

#define GNOMON_VERSION_MAJOR 0
#define GNOMON_VERSION_MINOR 1
#define GNOMON_VERSION_PATCH 0
#define GNOMON_VERSION (GNOMON_VERSION_MAJOR * 10000 + GNOMON_VERSION_MINOR * 100 + GNOMON_VERSION_PATCH)

#endif
