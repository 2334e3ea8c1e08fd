// Compiles the steps for the browser, unchanged, with the twins of what a browser lacks. Objects are kept by a hash of
// all that goes into them, so that only what has changed is compiled.
import { execFile } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { promisify } from 'node:util';
import { root } from './places.mjs';

const run = promisify(execFile);
const work = join(root, 'build/web');
const compiler = process.env.RAYSTEPS_WASM_CXX ?? 'clang++-19';
const target = ['--target=wasm32-wasi'];
const flags = [...target, '-std=c++20', '-O2', '-DNDEBUG', '-DGLM_FORCE_EXPLICIT_CTOR', '-ffp-contract=off',
    '-fno-math-errno', '-fno-trapping-math', '-fexceptions', '-Wno-psabi'];
const simd = ['-msimd128'];

export const steps = readdirSync(join(root, 'steps')).filter((name) => /^\d\d_/.test(name)).sort();

/** What every step's program is linked with, besides its main.cpp; from step 05 on also the tree and the models. */
const outside = ['site/twins/options.cpp', 'site/twins/program.cpp', 'site/twins/files.cpp', 'site/twins/parallel.cpp',
    'site/twins/throw.cpp', 'site/twins/math.cpp', 'common/cli/option_values.cpp', 'common/util/suggestion.cpp',
    'common/util/text.cpp'];
const models = ['accel/build.cpp', 'site/twins/system.cpp', 'common/util/huge_page_vector.cpp', 'common/model/vertex_normals.cpp',
    'common/model/transform.cpp'];

const hash = (...parts) => parts.reduce((sum, part) => sum.update(part).update('\0'), createHash('sha256')).digest('hex').slice(0, 24);
const usesModels = (step) => step >= '05';

/** The files that a source includes, with their contents; `overlay` has contents in place of those of steps/. */
function closure(source, overlay, found = new Map()) {
    const inSteps = join('steps', source);
    const file = overlay.has(source) || existsSync(join(root, inSteps)) ? inSteps : source;
    if (found.has(file) || !(overlay.has(source) || existsSync(join(root, file)))) return found;
    const text = overlay.get(source) ?? readFileSync(join(root, file), 'utf8');
    found.set(file, text);
    for (const [, include] of text.matchAll(/^\s*#\s*include\s+"([^"]+)"/gm)) closure(include, overlay, found);
    return found;
}

let version;
const limit = (() => { // runs so many compilers at a time
    let free = Number(process.env.RAYSTEPS_JOBS ?? availableParallelism());
    const waiting = [];
    return async (job) => {
        if (free > 0) --free; else await new Promise((go) => waiting.push(go));
        try { return await job(); } finally { if (waiting.length) waiting.shift()(); else ++free; }
    };
})();

/** Runs the compiler on a source, unless what it makes is there already, and answers where that is. */
async function compiled(source, { options, overlay, ending, mode }) {
    version ??= (await run(compiler, ['--version'])).stdout;
    const included = mode.filter((option) => option.endsWith('.h')).flatMap((path) => [...closure(relative(root, path), overlay)].flat());
    const key = hash(version, ...flags, ...options, ...mode, ...included, ...[...closure(source, overlay)].flat());
    const path = join(work, 'objects', `${source.replaceAll('/', '_').replace(/\.\w+$/, '')}.${key}.${ending}`);
    if (existsSync(path)) return path;
    const folder = `${path}.overlay`, fresh = `${path}.${process.pid}`, glm = join(work, 'include');
    for (const [name, text] of overlay) {
        mkdirSync(dirname(join(folder, name)), { recursive: true });
        writeFileSync(join(folder, name), text);
    }
    mkdirSync(dirname(path), { recursive: true });
    mkdirSync(glm, { recursive: true }); // not all of the system's headers: those are for another C library
    if (!existsSync(join(glm, 'glm'))) symlinkSync(process.env.RAYSTEPS_GLM ?? '/usr/include/glm', join(glm, 'glm'));
    const include = [...(overlay.size ? ['-I', folder] : []), '-I', join(root, 'steps'), '-I', root, '-isystem', glm];
    await limit(() => run(compiler, [...flags, ...options, ...include, ...mode, join(root, source), '-o', fresh]));
    rmSync(folder, { recursive: true, force: true });
    renameSync(fresh, path);
    return path;
}

const ahead = new Map(); // by options: what most steps include, parsed once

/** Compiles a source and answers the path of its object. */
async function object(source, options, overlay = new Map()) {
    if (!source.startsWith('steps/')) return compiled(source, { options, overlay, ending: 'o', mode: ['-c'] });
    const own = [...options.filter((option) => option.startsWith('-m')), '-Dmain=step_main'];
    const key = own.join(' ');
    if (!ahead.has(key))
        ahead.set(key, compiled('common/pch.h', { options: own, overlay: new Map(), ending: 'pch', mode: ['-x', 'c++-header'] }));
    const more = options.filter((option) => !own.includes(option));
    return compiled(source, { options: own, overlay, ending: 'o', mode: ['-include-pch', await ahead.get(key), ...more, '-c'] });
}

/** Links objects, unless that has been done, and answers the program's bytes. */
async function linked(name, objects) {
    const path = join(work, 'objects', `${name}.${hash(...objects)}.wasm`);
    if (!existsSync(path)) {
        const link = ['-mexec-model=reactor', '-Wl,-z,stack-size=1048576', '-Wl,--strip-all', '-Wl,--gc-sections',
            '-Wl,--export=__stack_pointer'];
        const fresh = `${path}.${process.pid}`;
        await limit(() => run(compiler, [...target, ...link, ...objects, '-o', fresh]));
        renameSync(fresh, path);
    }
    return readFileSync(path);
}

/**
 * Builds a step's program and answers its bytes. `overlay` maps names as in "01_spheres/sphere.h" to changed texts,
 * and `options` are further ones of the compiler.
 */
export async function program(step, overlay = new Map(), options = []) {
    const own = usesModels(step) ? [...simd, ...options] : options;
    const sources = [...outside, ...(usesModels(step) ? models : [])];
    const objects = await Promise.all([
        object(`steps/${step}/main.cpp`, own, overlay),
        ...sources.map((source) => object(source, usesModels(step) ? simd : []))]);
    return linked(step, objects);
}

/** Builds the program of the figures that explain, site/figures. */
export async function figures() {
    const own = readdirSync(join(root, 'site/figures')).filter((name) => name.endsWith('.cpp')).map((name) => `site/figures/${name}`);
    const options = (source) => (source.endsWith('/main.cpp') ? ['-Oz', '-Dmain=step_main'] : ['-Oz']); // small: they draw little
    return linked('figures', await Promise.all([...own, ...outside].map((source) => object(source, options(source)))));
}
