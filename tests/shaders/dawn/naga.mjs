// naga, the compiler of wgpu, and how a script says that something is not here.
import { basename } from "node:path";

export const unavailable = process.env.CI === "true" ? 1 : 77; // ctest's SKIP_RETURN_CODE; continuous integration skips nothing

export function skip(why) {
    console.error(`no WebGPU: ${why}`);
    process.exit(unavailable);
}

process.on("uncaughtException", (error) => {
    console.error(`${basename(process.argv[1])}: ${error.message}`);
    process.exit(2);
});

const { NagaError, parseWgsl, validate, writeWgsl } = await import("naga-wasm").catch(() => skip("naga is not here (target gnomon_heavy)"));

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

/// What a text defines: functions, constants, structs, and members as STRUCT.MEMBER.
function defined(text) {
    const code = text.replace(/\/\/.*/g, "");
    const members = [...code.matchAll(/^struct (\w+)\s*\{([^}]*)\}/gm)].flatMap(([, struct, body]) =>
        [...body.matchAll(/(\w+)\s*:/g)].map(([, member]) => `${struct}.${member}`));
    return [...[...code.matchAll(/^(?:const|fn|struct) (\w+)/gm)].map(([, name]) => name), ...members];
}

/// Names that are others once naga has read a text and written it.
export function renamed(text) {
    const module = parseWgsl(text);
    const written = new Set(defined(writeWgsl(module, validate(module))));
    return defined(text).filter((name) => !written.has(name));
}
