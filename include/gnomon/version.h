// The version of the headers: CMake reads it here, and #if GNOMON_VERSION >= 100 can be written in every language.
#ifndef GNOMON_VERSION_H
#define GNOMON_VERSION_H

#define GNOMON_VERSION_MAJOR 0
#define GNOMON_VERSION_MINOR 1
#define GNOMON_VERSION_PATCH 0
#define GNOMON_VERSION (GNOMON_VERSION_MAJOR * 10000 + GNOMON_VERSION_MINOR * 100 + GNOMON_VERSION_PATCH)

#endif
