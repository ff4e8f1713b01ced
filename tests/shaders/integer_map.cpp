// A shadow map in codes of 16 bits in an integer texture, written and filtered by the example of docs/shaders.md for OpenGL ES
// 3.0 without 16-bit UNORM, on Mesa's driver on the CPU: the texels are those of moments4_unorm16, the look-ups agree with
// the CPU's, no lit receiver is darkened, and no covered one is lit.
//
// usage: integer_map FOLDER    of example0.frag, which writes, and example1.frag, which reads
#include "gl_context.hpp"

#include <gnomon/passes/look_up.hpp>
#include <gnomon/storage/moments4.hpp>

#include <GLES3/gl3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using format = gnomon::moments4_unorm16;

constexpr int side = 64, view = 200; // of the map, and of the picture of receivers

struct plane {
    float offset, x, y; // depth = offset + x X + y Y, X and Y in [-1, 1]
    float at(float px, float py) const { return offset + x * px + y * py; }
};
constexpr plane ground{0.3f, 0.1f, -0.05f}, caster{0.1f, -0.02f, 0};
constexpr int left = 16, bottom = 20, width = 32, height = 20; // texels of the caster
constexpr float bias = 0.01f;                                  // two texels along the ground, and more

bool covered(int x, int y) { return left <= x && x < left + width && bottom <= y && y < bottom + height; }

/// The position of the centre of texel i of `count` in [-1, 1].
float centre(int i, int count) { return (float(i) + 0.5f) / float(count) * 2 - 1; }

constexpr const char* vertices = R"(#version 300 es
uniform highp vec3 plane;
out highp float depth;
out highp vec3 shadow_position;
void main()
{
    vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    depth = plane.x + dot(plane.yz, at);
    shadow_position = vec3(0.5 * at + 0.5, depth);
    gl_Position = vec4(at, 0.0, 1.0);
})";

void compile(GLuint program, GLenum stage, const std::string& text)
{
    const GLuint shader = glCreateShader(stage);
    const char* const texts[] = {text.c_str()};
    glShaderSource(shader, 1, texts, nullptr);
    glCompileShader(shader);
    std::array<char, 4096> log{};
    glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) throw std::runtime_error(log.data());
    glAttachShader(program, shader);
}

GLuint program_of(const std::string& file)
{
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file);
    const GLuint program = glCreateProgram();
    compile(program, GL_VERTEX_SHADER, vertices);
    compile(program, GL_FRAGMENT_SHADER, {std::istreambuf_iterator<char>(in), {}});
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) throw std::runtime_error(file + ": does not link");
    return program;
}

/// A texture that is drawn to from now on.
GLuint target(GLenum kind, int extent)
{
    GLuint texture = 0, frame = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, kind, extent, extent);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("a target is incomplete");
    glViewport(0, 0, extent, extent);
    return texture;
}

void draw(GLuint program, plane p)
{
    glUseProgram(program);
    glUniform3f(glGetUniformLocation(program, "plane"), p.offset, p.x, p.y);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// The map that the device writes, read back.
std::vector<format::texel> written(const std::string& file)
{
    const GLuint program = program_of(file);
    draw(program, ground);
    glEnable(GL_SCISSOR_TEST);
    glScissor(left, bottom, width, height);
    draw(program, caster);
    glDisable(GL_SCISSOR_TEST);
    std::vector<std::uint32_t> read(4 * side * side);
    glReadPixels(0, 0, side, side, GL_RGBA_INTEGER, GL_UNSIGNED_INT, read.data());
    std::vector<format::texel> map(side * side);
    for (std::size_t i = 0; i < read.size(); ++i) map[i / 4][i % 4] = static_cast<std::uint16_t>(read[i]);
    return map;
}

int fault(const char* what, int x, int y, double found)
{
    std::printf("%s at %d, %d: %g\n", what, x, y, found);
    return 1;
}

int run(const std::string& folder)
{
    const GLuint texture = target(GL_RGBA16UI, side);
    const std::vector<format::texel> map = written(folder + "/example0.frag");
    int faults = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float z = (covered(x, y) ? caster : ground).at(centre(x, side), centre(y, side));
            const format::texel expected = format::encode(format::from_depth(z));
            for (std::size_t k = 0; k < 4; ++k) { // depths are interpolated otherwise, codes rounded otherwise
                const int off = int(map[std::size_t(y * side + x)][k]) - int(expected[k]);
                if (std::abs(off) > 1) faults += fault("a code is off", x, y, off);
            }
        }

    const GLuint program = program_of(folder + "/example1.frag");
    target(GL_R32F, view);
    glBindTexture(GL_TEXTURE_2D, texture);
    draw(program, {ground.offset - bias, ground.x, ground.y});
    std::vector<float> picture(4 * view * view);
    glReadPixels(0, 0, view, view, GL_RGBA, GL_FLOAT, picture.data());
    if (const GLenum error = glGetError()) throw std::runtime_error("OpenGL error " + std::to_string(error));

    double difference = 0;
    int lit = 0, dark = 0;
    for (int y = 0; y < view; ++y)
        for (int x = 0; x < view; ++x) {
            const float u = (float(x) + 0.5f) * side / view, v = (float(y) + 0.5f) * side / view;
            const float z_f = ground.at(centre(x, view), centre(y, view)) - bias;
            const gnomon::map_view<const format::texel> texels(map, side, side);
            const double cpu = double(format::filtered_intensity(gnomon::bilinear<format>(texels, u, v), z_f));
            const double found = double(picture[std::size_t(4 * (y * view + x))]);
            difference = std::max(difference, std::abs(found - cpu));
            double truth = 0;
            const float px = u - 0.5f, py = v - 0.5f;
            for (int k = 0; k < 4; ++k) {
                const int i = int(std::floor(px)) + k % 2, j = int(std::floor(py)) + k / 2;
                if (covered(i, j)) truth += double((1 - std::abs(px - float(i))) * (1 - std::abs(py - float(j))));
            }
            if (!(found <= truth + 1e-3)) faults += fault("darker than the truth", x, y, found - truth);
            if (truth == 0 && !(found <= format::filtered_darkening)) faults += fault("a lit receiver", x, y, found);
            if (truth > 0.999 && !(found > 0.98)) faults += fault("a covered receiver", x, y, found);
            lit += truth == 0;
            dark += truth > 0.999;
        }
    // The error of float arithmetic that storage/moments4.h states: the device's is ordered otherwise.
    if (!(difference <= 3e-2)) faults += fault("the CPU differs", 0, 0, difference);
    if (lit < 1000 || dark < 1000) faults += fault("receivers", 0, 0, lit);
    std::printf("%d lit, %d covered receivers, largest difference to the CPU %.2g, %d faults\n", lit, dark, difference,
                faults);
    return faults > 0 ? 1 : 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) return 2;
    try {
        const gnomon::parity::gl_context current(gnomon::parity::gl_api::es, 3, 0);
        return run(argv[1]);
    } catch (const gnomon::parity::unavailable& e) {
        std::printf("skipped: %s\n", e.what());
        const char* ci = std::getenv("CI");
        return ci != nullptr && std::string(ci) == "true" ? 1 : 77;
    } catch (const std::exception& e) {
        std::puts(e.what());
        return 1;
    }
}
