// The camera and the air around a rectified map, the same struct in C++, GLSL and HLSL. Light axes: x is the light's right, y
// its up, z its direction, and the origin is the eye.
struct rectified_view {
    vec4 eye;                 // in the shadow map: texels along x and y, signed depth; texels of the map along a side
    vec4 light;               // of the shadow map: texels per unit of x and y, length of a unit of depth; 1 if depth is a cosine
    vec4 frame;               // of the rectified map: radius, start and span of azimuths; 1 if the span is a full turn
    vec4 texel;               // of the rectified map: extent along a row, angle between rows; columns, rows
    vec4 corner, right, down; // view rays at distance 1 in light axes: to the upper left corner, and from there over the picture
    vec4 planes;              // of the camera: near, far, extent of a pixel at distance 1; asymmetry of the air
    vec4 scattering, extinction, irradiance;
};
