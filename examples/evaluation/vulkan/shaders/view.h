// Camera, light and materials of a frame, the same struct in C++, GLSL and HLSL. Rows are of matrices: their product
// with (position, 1) is a coordinate.
struct view {
    vec4 light_rows[3]; // texture coordinates and signed depth in the shadow map
    vec4 eye;           // position
    vec4 to_light;      // direction
    vec4 sun, sky, earth;
    vec4 bias; // depth bias at slope 1 and level 0, the steepest slope, texels of the map along a side, roundings of a blended map
    vec4 slope_u, slope_v; // their products with a normal, by that of to_light: change of depth per texel along u and v
    vec4 penumbra; // texels per unit of signed depth along u and v, the widest search in texels
    vec4 table;    // texels of the largest region, scale of the codes, strength of over-darkening
};
