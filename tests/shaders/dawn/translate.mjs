// Has naga translate modules of SPIR-V (translated.py).
//
// usage: translate.mjs TARGET MODULES OUTPUT ENDING KERNEL...    TARGET is hlsl, msl, or a version of GLSL
import { parseSpirv, validate, writeGlsl, writeHlsl, writeMsl } from "naga-wasm";
import { readFileSync, writeFileSync } from "node:fs";

const [target, modules, output, ending, ...kernels] = process.argv.slice(2);

function translated(module) {
    const info = validate(module);
    if (target === "hlsl") return writeHlsl(module, info, { shaderModel: "6_0" });
    if (target === "msl") return writeMsl(module, info, {});
    return writeGlsl(module, info, { version: target, stage: ending === ".frag" ? "fragment" : "compute", entryPoint: "main" });
}

for (const kernel of kernels) {
    const text = translated(parseSpirv(readFileSync(`${modules}/${kernel}.spv`)));
    writeFileSync(`${output}/${kernel}${ending}`, text);
}
