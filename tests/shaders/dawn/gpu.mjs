// A device of Dawn, the WebGPU implementation of Chromium, on Chromium's Vulkan driver for the CPU; and what Tint, Dawn's
// compiler, and naga have to say about a text in WGSL.
import { existsSync } from "node:fs";
import { basename } from "node:path";

const unavailable = process.env.CI === "true" ? 1 : 77; // ctest's SKIP_RETURN_CODE; continuous integration skips nothing
const swiftshader = "/usr/lib/chromium/vk_swiftshader_icd.json";

function skip(why) {
    console.error(`no WebGPU: ${why}`);
    process.exit(unavailable);
}

process.on("uncaughtException", (error) => {
    console.error(`${basename(process.argv[1])}: ${error.message}`);
    process.exit(2);
});

const [{ create, globals }, { NagaError, parseWgsl, validate }] = await Promise.all([import("webgpu"), import("naga-wasm")])
    .catch(() => skip("Dawn and naga are not here (target gnomon_heavy)"));
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

/// naga's report, empty where there is nothing to say.
export function naga_complaint(text) {
    try {
        validate(parseWgsl(text)).free();
        return "";
    } catch (error) {
        if (error instanceof NagaError) return error.formatted;
        throw error;
    }
}
