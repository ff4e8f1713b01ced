// A moving triangle as the texels of one tile of the shadow map see it, and which steps the kernels of ranges take. The same
// structs in C++, GLSL and HLSL.
const int side_positive = 1, side_negative = 2; // the triangle turns this side to the light at some time
const int depth_linear = 4;                     // all of its edges are linear in time, and the depths of its corners change alike
const int edge_a_linear = 8, edge_b_linear = 16, edge_c_linear = 32;

struct tile_record {
    triangle_setup equations; // widened for the facing 1, relative to the middle of the tile
    depth_setup depths;
    float margin_a, margin_b, margin_c; // by which the equations are widened
    float number;                       // counted through all meshes
    int bits;
};
