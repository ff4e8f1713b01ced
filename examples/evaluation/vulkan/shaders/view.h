// Camera, light and materials of a frame, the same struct in C++, GLSL and HLSL. Rows are of matrices: their product
// with (position, 1) is a coordinate.
struct view {
    vec4 light_rows[3]; // texture coordinates and signed depth in the shadow map
    vec4 eye;           // position
    vec4 to_light;      // direction
    vec4 sun, sky, earth;
    vec4 bias; // depth bias at slope 1 and level 0, the steepest slope, texels of the map along a side
};
