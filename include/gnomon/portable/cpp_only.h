// The first include of every .hpp, directly or through another .hpp: stops a shader compiler with a clear message,
// since these files are C++ only.
#ifndef GNOMON_PORTABLE_CPP_ONLY_H
#define GNOMON_PORTABLE_CPP_ONLY_H

#if !defined(__cplusplus) || defined(__METAL_VERSION__) || defined(__OPENCL_CPP_VERSION__)
#error "gnomon: a .hpp is C++ only; shaders include the .h files or a package"
#endif

#endif
