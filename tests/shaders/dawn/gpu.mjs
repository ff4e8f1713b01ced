// A device of Dawn, the WebGPU implementation of Chromium, on Chromium's Vulkan driver for the CPU; and what Tint, Dawn's
// compiler, has to say about a text in WGSL.
import { existsSync } from "node:fs";
import { skip } from "./naga.mjs";

const swiftshader = "/usr/lib/chromium/vk_swiftshader_icd.json";
const { create, globals } = await import("webgpu").catch(() => skip("Dawn is not here (target gnomon_heavy)"));
Object.assign(globalThis, globals);
process.env.VK_ICD_FILENAMES = swiftshader;
process.env.XDG_RUNTIME_DIR ??= "/tmp"; // a library below complains of none
const gpu = create([]); // must outlive its devices

export async function open_device() {
    const adapter = existsSync(swiftshader) && (await gpu.requestAdapter());
    if (!adapter) skip("Dawn wants SwiftShader (chromium) and a Vulkan loader (libvulkan1)");
    const { maxBufferSize, maxStorageBufferBindingSize } = adapter.limits;
    return adapter.requestDevice({ requiredLimits: { maxBufferSize, maxStorageBufferBindingSize } });
}

/// The module, and all that Tint says, warnings too.
export async function compile(device, text) {
    const module = device.createShaderModule({ code: text });
    const { messages } = await module.getCompilationInfo();
    return { module, complaints: messages.map((m) => `${m.lineNum}:${m.linePos}: ${m.type}: ${m.message}`) };
}
