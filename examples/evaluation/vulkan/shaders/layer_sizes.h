// Sizes of layered shadow maps, the settings of Andersson et al. 2015 for maps of 512 x 512 texels. The same text in C++, GLSL and
// HLSL, as are the structs.
const int layer_tile = 4;   // texels of the light's map along a tile
const int layer_guard = 12; // along the window around a tile
const int layer_side = 8;   // texels of a layer
const int layer_block = 32; // texels of the light's map along a block of the plain map

// The clusters of a tile: cuts between its layers, how many layers it has, and 1 where something in the window moves.
struct tile_layers {
    float c0, c1, c2;
    uint layers, moves;
};

struct layer_push {
    uint width, samples; // of the light's map, along a side, and for each texel
    uint level;          // of the plain map
    uint tiles;          // that look-ups read: 0 the receiver's, 1 one at random, 2 the blend of all
    uint receivers;
    float reach, limit, rounding, least_variance; // of look-ups, as of passes/layers/layer_look_up.hpp, and of the format
};
