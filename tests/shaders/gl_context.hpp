// A context of OpenGL or OpenGL ES without a window: Mesa's platform without surfaces, and its driver on the CPU.
#pragma once

#include "route.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace gnomon::parity {

enum class gl_api : EGLenum { es = EGL_OPENGL_ES_API, desktop = EGL_OPENGL_API };

/// Current from its construction, and after use(), until another is.
class gl_context {
  public:
    gl_context(gl_api api, EGLint major, EGLint minor) : api_(api)
    {
        setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
        display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
            throw unavailable("no EGL without surfaces (libegl-mesa0, libgl1-mesa-dri)");
        eglBindAPI(EGLenum(api));
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor, EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
        if (context_ == EGL_NO_CONTEXT || !use()) // the display may be another context's, too
            throw unavailable("no OpenGL" + std::string(api == gl_api::es ? " ES " : " ") + std::to_string(major) +
                              '.' + std::to_string(minor) + " without surfaces");
    }
    gl_context(const gl_context&) = delete;
    gl_context& operator=(const gl_context&) = delete;
    ~gl_context()
    {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }

    bool use() const
    {
        return eglBindAPI(EGLenum(api_)) && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    }

  private:
    gl_api api_;
    EGLDisplay display_;
    EGLContext context_;
};

inline std::string read_text(const std::filesystem::path& file)
{
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace gnomon::parity
