// Each value times the push constant, plus the specialization constant.
#version 450
layout(local_size_x = 64) in;
layout(constant_id = 0) const float added = 0;
layout(push_constant) uniform push { float factor; };
layout(binding = 0) readonly buffer input_buffer { float values[]; };
layout(binding = 1) writeonly buffer output_buffer { float results[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    results[i] = values[i] * factor + added;
}
