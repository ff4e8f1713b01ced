// A row of a rectified map of a homogeneous medium: the direction of its middle, its range of depth, and the transmittance and
// the optical depth of a texel. The same struct in C++, GLSL and HLSL.
struct rectified_row {
    float cosine, sine;
    float middle, scale;
    float factor, optical_depth;
};
