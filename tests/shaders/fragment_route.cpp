// Fragment shaders on OpenGL ES 3.0 and OpenGL 3.3, which have no compute shaders.
#include "gl_context.hpp"
#include "support/kernel_call.hpp"

#include <GLES3/gl3.h>

#include <bit>
#include <cstdint>

namespace gnomon::parity {

namespace {

constexpr GLsizei width = 2048; // of all textures

constexpr const char* vertices =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
    "gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }";

class program {
  public:
    program(const std::string& version, const std::filesystem::path& file)
    {
        attach(GL_VERTEX_SHADER, version + vertices, file);
        attach(GL_FRAGMENT_SHADER, read_text(file), file);
        glLinkProgram(name_);
        GLint linked = GL_FALSE;
        glGetProgramiv(name_, GL_LINK_STATUS, &linked);
        if (linked) return;
        std::string log(1 << 14, '\0');
        glGetProgramInfoLog(name_, GLsizei(log.size()), nullptr, log.data());
        throw std::runtime_error(file.string() + ": " + log.c_str());
    }
    program(const program&) = delete;
    program& operator=(const program&) = delete;
    ~program() { glDeleteProgram(name_); }

    GLuint name() const { return name_; }

  private:
    void attach(GLenum kind, const std::string& text, const std::filesystem::path& file) const
    {
        const GLuint shader = glCreateShader(kind);
        const char* const texts[] = {text.c_str()};
        glShaderSource(shader, 1, texts, nullptr);
        glCompileShader(shader);
        glAttachShader(name_, shader);
        GLint compiled = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        std::string log(1 << 14, '\0');
        glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
        glDeleteShader(shader);
        if (!compiled) throw std::runtime_error(file.string() + ": " + log.c_str());
    }

    GLuint name_ = glCreateProgram();
};

/// Whole numbers of 32 bits, one channel or four.
class texture {
  public:
    texture(GLenum format, GLenum channels, std::size_t texels, const void* data)
        : height_(GLsizei((texels + width - 1) / width))
    {
        glGenTextures(1, &name_);
        glBindTexture(GL_TEXTURE_2D, name_);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height_);
        if (data == nullptr) return;
        // The last row may be shorter than the texture.
        const auto rows = GLsizei(texels / width), rest = GLsizei(texels % width);
        const auto* numbers = static_cast<const std::uint32_t*>(data);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, rows, channels, GL_UNSIGNED_INT, numbers);
        if (rest > 0)
            glTexSubImage2D(GL_TEXTURE_2D, 0, 0, rows, rest, 1, channels, GL_UNSIGNED_INT,
                            numbers + std::size_t(rows) * width);
    }
    texture(const texture&) = delete;
    texture& operator=(const texture&) = delete;
    ~texture() { glDeleteTextures(1, &name_); }

    GLuint name() const { return name_; }
    GLsizei height() const { return height_; }

  private:
    GLuint name_ = 0;
    GLsizei height_;
};

class fragment_shaders final : public route {
  public:
    fragment_shaders(std::filesystem::path folder, bool es)
        : folder_(std::move(folder)),
          version_(es ? "#version 300 es\n" : "#version 330\n"),
          context_(es ? gl_api::es : gl_api::desktop, 3, es ? 0 : 3)
    {
        GLuint name = 0;
        glGenVertexArrays(1, &name);
        glBindVertexArray(name);
        glGenFramebuffers(1, &name);
        glBindFramebuffer(GL_FRAMEBUFFER, name);
    }

    void run(const kernel& k, std::span<const float> in, std::span<float> out) override
    {
        if (!context_.use()) throw std::runtime_error("EGL has lost its context");
        const std::size_t rows = in.size() / k.inputs, parts = (k.outputs + 3) / 4;
        const program code(version_, folder_ / (std::string(k.name) + ".frag"));
        const texture target(GL_RGBA32UI, GL_RGBA_INTEGER, rows * parts, nullptr);
        const texture source(GL_R32UI, GL_RED_INTEGER, in.size(), in.data());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.name(), 0);
        glViewport(0, 0, width, target.height());
        glUseProgram(code.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<std::uint32_t> read(std::size_t(width) * std::size_t(target.height()) * 4);
        glReadPixels(0, 0, width, target.height(), GL_RGBA_INTEGER, GL_UNSIGNED_INT, read.data());
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            complaints_.push_back(std::string(k.name) + ": OpenGL error " + std::to_string(error));
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t j = 0; j < k.outputs; ++j)
                out[i / test::block_rows * test::block_rows * k.outputs + j * test::block_rows + i % test::block_rows] =
                    std::bit_cast<float>(read[i * parts * 4 + j]);
    }
    std::string device() const override { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }
    std::vector<std::string> complaints() const override { return complaints_; }

  private:
    std::filesystem::path folder_;
    std::string version_;
    gl_context context_;
    std::vector<std::string> complaints_;
};

} // namespace

std::unique_ptr<route> fragment_route(const std::filesystem::path& folder, bool es)
{
    if (!exists(folder)) throw unavailable("no shaders in " + folder.string());
    return std::make_unique<fragment_shaders>(folder, es);
}

} // namespace gnomon::parity
