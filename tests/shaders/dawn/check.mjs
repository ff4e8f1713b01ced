// Shows texts in WGSL to naga and to Tint: neither may have anything to say, and naga, which writes what it has read, renames
// nothing that a text defines.
//
// usage: check.mjs FOLDER    prints what they say; exit code 1 if they say anything
import { readFileSync, readdirSync } from "node:fs";
import { compile, open_device } from "./gpu.mjs";
import { naga_complaint, renamed } from "./naga.mjs";

const device = await open_device();
const folder = process.argv[2];
const files = readdirSync(folder).filter((name) => name.endsWith(".wgsl"));
let refused = 0;
for (const file of files) {
    const text = readFileSync(`${folder}/${file}`, "utf8");
    const said = [naga_complaint(text), ...(await compile(device, text)).complaints].filter(Boolean);
    const names = said.length ? [] : renamed(text);
    if (names.length) said.push(`naga renames ${names.join(", ")}`);
    for (const complaint of said) console.log(`${file}: ${complaint}`);
    refused += said.length > 0;
}
device.destroy();
console.log(`${files.length} texts, ${refused} refused`);
process.exitCode = Number(refused > 0 || files.length === 0);
