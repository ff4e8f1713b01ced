// A device of Dawn, the WebGPU implementation of Chromium, on Chromium's Vulkan driver for the CPU, or on Mesa's OpenGL ES, for
// which Tint, Dawn's compiler, writes ESSL; and what Tint has to say about a text in WGSL.
import { existsSync } from "node:fs";
import { skip } from "./naga.mjs";

const swiftshader = "/usr/lib/chromium/vk_swiftshader_icd.json";
const { create, globals } = await import("webgpu").catch(() => skip("Dawn is not here (target gnomon_heavy)"));
Object.assign(globalThis, globals);
process.env.VK_ICD_FILENAMES = swiftshader;
process.env.XDG_RUNTIME_DIR ??= "/tmp"; // a library below complains of none
process.env.EGL_PLATFORM = "surfaceless";
let gpu; // must outlive its devices

/// backend: vulkan or opengles
export async function open_device(backend = "vulkan") {
    gpu = create([`backend=${backend}`]);
    const adapter = (backend === "opengles" || existsSync(swiftshader)) && (await gpu.requestAdapter({ featureLevel: "compatibility" }));
    if (!adapter) skip("Dawn wants SwiftShader (chromium) and a Vulkan loader (libvulkan1), or OpenGL ES (libegl1, libgl1-mesa-dri)");
    const { maxBufferSize, maxStorageBufferBindingSize } = adapter.limits;
    return adapter.requestDevice({ requiredLimits: { maxBufferSize, maxStorageBufferBindingSize } });
}

/// The module, and all that Tint says, warnings too.
export async function compile(device, text) {
    const module = device.createShaderModule({ code: text });
    const { messages } = await module.getCompilationInfo();
    return { module, complaints: messages.map((m) => `${m.lineNum}:${m.linePos}: ${m.type}: ${m.message}`) };
}
