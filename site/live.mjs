// The scripts that bring pictures to life: a step's program, the models that it reads, and its mistakes, as text that a page
// opened as a file can load.
import { execFile } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { gzipSync } from 'node:zlib';
import { switches } from './mistakes.mjs';
import { root } from './places.mjs';
import { traced_patch } from './traces.mjs';
import { figures, program, steps } from './wasm.mjs';
import './page/program.js';

const run = promisify(execFile);
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString('base64');
const script = (table, name, value) => `((globalThis.RAYSTEPS ??= {}).${table} ??= {})[${JSON.stringify(name)}] = ${JSON.stringify(value)};\n`;

/** Which files a step's scenes read. */
export const assets = {
    '05_mesh_bvh': ['teapot_fine.obj', 'teapot_coarse.obj', 'cat_coarse.obj', 'cat.obj'],
    '06_textures': ['globe.png', 'test_card.png', 'cow.obj', 'cat.obj'],
    '07_antialias': ['cat.obj'],
    '08_indirect': ['cow.obj', 'cat.obj'],
};

/** Reads the models with the native reader, and answers where their plain bytes are. */
export async function packed_assets() {
    const folder = join(root, 'build/web/assets'), native = process.env.RAYSTEPS_BUILD ?? join(root, 'build/release');
    const names = [...new Set(Object.values(assets).flat())];
    mkdirSync(folder, { recursive: true });
    const paths = names.map((name) => [join(root, 'assets', name), join(native, 'assets', name)].find(existsSync) ?? name);
    const tool = join(native, 'bin/pack_assets');
    const newest = Math.max(...paths.map((path) => (existsSync(path) ? statSync(path).mtimeMs : Infinity)));
    if (names.some((name) => !existsSync(join(folder, name)) || statSync(join(folder, name)).mtimeMs < newest))
        await run(tool, [folder, ...paths]);
    return folder;
}

/** Throws unless the program of a live comment takes its words and has its options. */
export async function check_live({ file, step, options, words }) {
    const fail = (problem) => { throw new Error(`${file}: <!-- live: ${step} ... -->: ${problem}`); };
    if (/^\d/.test(step) && !steps.includes(step)) fail('there is no such step');
    const page = new Raysteps.Program(new WebAssembly.Module(await (/^\d/.test(step) ? program(step) : figures())), await files_of(step));
    let declared;
    try {
        declared = page.start(/^\d/.test(step) ? words : [step, ...words]);
    } catch (problem) {
        fail(problem.message);
    }
    for (const name of options)
        if (!declared.options.some((option) => option.name === name)) fail(`it has no option --${name}`);
}

/** The files that a step's program reads, as the page hands them over. */
export async function files_of(step) {
    const folder = await packed_assets();
    return Object.fromEntries((assets[step] ?? []).map((name) => [name, readFileSync(join(folder, name))]));
}

/** Writes step_*.js, asset_*.js and mistakes_*.js; answers their sizes. */
export async function write_scripts(out, with_mistakes, say) {
    const folder = await packed_assets();
    for (const name of new Set(steps.flatMap((step) => assets[step] ?? [])))
        writeFileSync(join(out, `asset_${name}.js`), script('assets', name, packed(readFileSync(join(folder, name)))));
    await Promise.all(steps.map(async (step) => {
        writeFileSync(join(out, `step_${step}.js`), script('steps', step, { wasm: packed(await program(step)), files: assets[step] ?? [] }));
        writeFileSync(join(out, `trace_${step}.js`), script('traces', step, packed(await traced_patch(step))));
        say(`${step}: program`);
    }));
    writeFileSync(join(out, 'drawings.js'), script('drawings', 'wasm', packed(await figures())));
    for (const step of with_mistakes) {
        const { list, patches } = await switches(step);
        writeFileSync(join(out, `mistakes_${step}.js`), script('mistakes', step, { list, patches: patches.toString('base64') }));
        say(`${step}: ${list.length} mistakes`);
    }
}
