// Composes shaders of packages in Bevy's form by naga_oil, which is Bevy's composer; naga must have nothing to say of the result.
//
// usage: bevy.mjs FOLDER    prints what they say; exit code 1 if they say anything
//
// FOLDER holds packages that begin with #define_import_path, of each of which a shader calls every function, and shaders that
// begin with #import, in files whose names begin with example.
import { readFileSync, readdirSync } from "node:fs";
import { naga_complaint, skip } from "./naga.mjs";

const built = new URL("node_modules/@antv/g-device-api/dist/pkg/", import.meta.url); // not among what the package exports
const { initSync, WGSLComposer } = await import(new URL("glsl_wgsl_compiler.js", built)).catch(
    () => skip("naga_oil is not here (target gnomon_heavy)"));
const module = new WebAssembly.Module(readFileSync(new URL("glsl_wgsl_compiler_bg.wasm", built)));

/// The composer's complaint, else naga's of what it composed.
function complaint(packages, shader) {
    const said = [];
    const log = console.log;
    console.log = (...words) => said.push(words.join(" "));
    try {
        initSync(module); // anew, since a refusal leaves a composer useless
        const composer = new WGSLComposer();
        for (const text of packages) composer.load_composable(text);
        return naga_complaint(composer.wgsl_compile(shader));
    } catch (error) {
        return said.join("; ") || error.message;
    } finally {
        console.log = log;
    }
}

/// A shader that imports a package and calls every function in it.
function caller(path, text) {
    const type = (name) => (/^(f32|i32|bool)$/.test(name) ? name : `g::${name}`);
    const calls = [...text.matchAll(/^fn (\w+)\(([^)]*)\)/gm)].map(([, name, parameters]) => {
        const types = [...parameters.matchAll(/: (\w+)/g)].map(([, word]) => type(word));
        const declared = types.map((word, i) => `var a${i}: ${word}; `).join("");
        return `    { ${declared}let r = g::${name}(${types.map((_, i) => `a${i}`).join(", ")}); }\n`;
    });
    return `#import ${path} as g\n@compute @workgroup_size(1)\nfn main()\n{\n${calls.join("")}}\n`;
}

const folder = process.argv[2];
const read = (names) => names.map((name) => [name, readFileSync(`${folder}/${name}`, "utf8")]);
const files = readdirSync(folder).filter((name) => name.endsWith(".wgsl"));
const packages = read(files.filter((name) => !name.startsWith("example")));
const shaders = read(files.filter((name) => name.startsWith("example")));
const units = packages.map(([name, text]) => [name, [text], caller(text.match(/^#define_import_path (\S+)/)[1], text)]);
for (const [name, text] of shaders) units.push([name, packages.map(([, text]) => text), text]);

let refused = 0;
for (const [name, texts, shader] of units) {
    const said = complaint(texts, shader);
    if (said) console.log(`${name}: ${said}`);
    refused += said !== "";
}
console.log(`${packages.length} packages, ${shaders.length} examples, ${refused} refused`);
process.exitCode = Number(refused > 0 || packages.length === 0);
