// Shows packages in WGSL to naga and to Tint: neither may have anything to say.
//
// usage: check.mjs FOLDER    prints what they say; exit code 1 if they say anything
import { readFileSync, readdirSync } from "node:fs";
import { compile, naga_complaint, open_device } from "./gpu.mjs";

const device = await open_device();
const folder = process.argv[2];
const files = readdirSync(folder).filter((name) => name.endsWith(".wgsl"));
let refused = 0;
for (const file of files) {
    const text = readFileSync(`${folder}/${file}`, "utf8");
    const said = [naga_complaint(text), ...(await compile(device, text)).complaints].filter(Boolean);
    for (const complaint of said) console.log(`${file}: ${complaint}`);
    refused += said.length > 0;
}
device.destroy();
console.log(`${files.length} packages, ${refused} refused`);
process.exitCode = Number(refused > 0 || files.length === 0);
