// Transformations of nodes from their parts, for the readers of models.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>
#include <stdexcept>

namespace gnomon::renderer {

// Scales, then rotates, then translates.
inline glm::dmat4 composed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale)
{
    return glm::scale(glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation), scale);
}

// The quaternion scaled to length one. Throws if its length is 0 or not finite.
inline glm::dquat unit(const glm::dquat& q)
{
    const double length = glm::length(q);
    if (!(length > 0 && std::isfinite(length))) throw std::runtime_error("a rotation has no length");
    return q / length;
}

// The matrix of 16 numbers, column by column. Throws if its last row is not that of an affine matrix.
inline glm::dmat4 affine(const double* numbers)
{
    glm::dmat4 matrix = glm::make_mat4(numbers);
    for (int column = 0; column < 4; ++column) {
        const double expected = column == 3 ? 1 : 0;
        if (!(std::abs(matrix[column][3] - expected) < 1e-5)) throw std::runtime_error("a matrix is not affine");
        matrix[column][3] = expected;
    }
    return matrix;
}

// The matrix that transforms normals: the inverse transpose up to a positive factor, also of a matrix without an
// inverse.
inline glm::dmat3 for_normals(const glm::dmat4& matrix)
{
    const glm::dmat3 m(matrix);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

} // namespace gnomon::renderer
