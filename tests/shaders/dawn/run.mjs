// Runs one kernel over rows of numbers in files (command_route of route.hpp).
//
// usage: run.mjs BACKEND SHADERS KERNEL INPUTS OUTPUTS IN OUT
//
// SHADERS is a file in WGSL with an entry point parity_KERNEL, or a folder with KERNEL.spv, which naga turns into WGSL.
import { parseSpirv, validate, writeWgsl } from "naga-wasm";
import { readFileSync, writeFileSync } from "node:fs";
import { compile, open_device } from "./gpu.mjs";

const block_rows = 64; // kernel_call.hpp
const [backend, shaders, kernel, inputs, outputs, from, to] = process.argv.slice(2);

// naga writes the largest float in eight digits, which name a number beyond it: Tint refuses that.
function wgsl_of(spirv) {
    const module = parseSpirv(spirv);
    return writeWgsl(module, validate(module)).replace(/\b34028235(0{31})f\b/g, "0x1.fffffep+127f");
}

const from_text = shaders.endsWith(".wgsl");
const text = from_text ? readFileSync(shaders, "utf8") : wgsl_of(readFileSync(`${shaders}/${kernel}.spv`));
const rows = readFileSync(from);
const blocks = rows.byteLength / (4 * block_rows * Number(inputs));
const bytes = blocks * 4 * block_rows * Number(outputs);

const device = await open_device(backend);
const { module, complaints } = await compile(device, text);
if (complaints.length) {
    console.error(`${kernel}: ${complaints.join("\n")}`);
    process.exit(1);
}
const pipeline = await device.createComputePipelineAsync({
    layout: "auto",
    compute: { module, entryPoint: from_text ? `parity_${kernel}` : "main" },
});

const input = device.createBuffer({ size: rows.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
const output = device.createBuffer({ size: bytes, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
const readable = device.createBuffer({ size: bytes, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
device.queue.writeBuffer(input, 0, rows);

const encoder = device.createCommandEncoder();
const pass = encoder.beginComputePass();
pass.setPipeline(pipeline);
pass.setBindGroup(0, device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: [input, output].map((buffer, binding) => ({ binding, resource: { buffer } })),
}));
pass.dispatchWorkgroups(blocks);
pass.end();
encoder.copyBufferToBuffer(output, 0, readable, 0, bytes);
device.queue.submit([encoder.finish()]);

await readable.mapAsync(GPUMapMode.READ);
writeFileSync(to, Buffer.from(readable.getMappedRange()));
device.destroy();
