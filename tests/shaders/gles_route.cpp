// Compute shaders on OpenGL ES, without a window: Mesa's platform without surfaces, and its driver on the CPU.
#include "gl_context.hpp"
#include "support/kernel_call.hpp"

#include <GLES3/gl32.h>

#include <algorithm>

namespace gnomon::parity {

namespace {

class program {
  public:
    explicit program(const std::filesystem::path& file)
    {
        const std::string text = read_text(file);
        const char* const texts[] = {text.c_str()};
        name_ = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, texts);
        GLint linked = GL_FALSE;
        glGetProgramiv(name_, GL_LINK_STATUS, &linked);
        if (linked) return;
        std::string log(1 << 14, '\0');
        glGetProgramInfoLog(name_, GLsizei(log.size()), nullptr, log.data());
        glDeleteProgram(name_);
        throw std::runtime_error(file.string() + ": " + log.c_str());
    }
    program(const program&) = delete;
    program& operator=(const program&) = delete;
    ~program() { glDeleteProgram(name_); }

    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

class storage_buffer {
  public:
    storage_buffer(GLuint binding, std::span<const float> numbers)
    {
        glGenBuffers(1, &name_);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
        glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(numbers.size_bytes()), numbers.data(), GL_DYNAMIC_READ);
    }
    storage_buffer(const storage_buffer&) = delete;
    storage_buffer& operator=(const storage_buffer&) = delete;
    ~storage_buffer() { glDeleteBuffers(1, &name_); }

    void read(std::span<float> numbers) const
    {
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
        const auto bytes = GLsizeiptr(numbers.size_bytes());
        const auto* from =
            static_cast<const float*>(glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, bytes, GL_MAP_READ_BIT));
        if (from == nullptr) throw std::runtime_error("OpenGL ES cannot map its results");
        std::copy_n(from, numbers.size(), numbers.begin());
        glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    }

  private:
    GLuint name_ = 0;
};

class compute_shaders final : public route {
  public:
    explicit compute_shaders(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void run(const kernel& k, std::span<const float> in, std::span<float> out) override
    {
        if (!context_.use()) throw std::runtime_error("EGL has lost its context");
        const program code(folder_ / (std::string(k.name) + ".comp"));
        const storage_buffer inputs(0, in), outputs(1, out);
        glUseProgram(code.name());
        glDispatchCompute(GLuint(in.size() / (k.inputs * test::block_rows)), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        outputs.read(out);
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            complaints_.push_back(std::string(k.name) + ": OpenGL ES error " + std::to_string(error));
    }
    std::string device() const override { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }
    std::vector<std::string> complaints() const override { return complaints_; }

  private:
    std::filesystem::path folder_;
    gl_context context_{gl_api::es, 3, 2};
    std::vector<std::string> complaints_;
};

} // namespace

std::unique_ptr<route> gles_route(const std::filesystem::path& folder)
{
    if (!exists(folder)) throw unavailable("no shaders in " + folder.string());
    return std::make_unique<compute_shaders>(folder);
}

} // namespace gnomon::parity
