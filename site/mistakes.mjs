// Mistakes as switches: each known mistake as a patch of the right program's bytes, a few hundred bytes in place of 120,000.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { catalogue, with_mistake } from './catalogue.mjs';
import { root } from './places.mjs';
import { program } from './wasm.mjs';

const width = 12; ///< a shorter match costs as much as it saves

/** Answers how `target` is made of parts of `base` and new bytes; Raysteps.patched in page/program.js applies it. */
export function patch_of(base, target) {
    const key = (bytes, at) => bytes.toString('latin1', at, at + width);
    const places = new Map();
    for (let at = base.length - width; at >= 0; --at) places.set(key(base, at), at);
    const parts = [];
    let copied = { from: 0, size: 0 }, fresh = 0;
    const flush = (end) => {
        const head = Buffer.alloc(12);
        [copied.from, copied.size, end - fresh].forEach((number, i) => head.writeUInt32LE(number, 4 * i));
        parts.push(head, target.subarray(fresh, end));
    };
    for (let at = 0; at < target.length;) {
        const wanted = key(target, at), near = copied.from + copied.size + at - fresh; // what followed the last copy
        const from = at + width > target.length ? undefined : key(base, near) === wanted ? near : places.get(wanted);
        if (from === undefined) { ++at; continue; }
        flush(at);
        let size = width;
        while (from + size < base.length && at + size < target.length && base[from + size] === target[at + size]) ++size;
        copied = { from, size };
        fresh = at += size;
    }
    flush(target.length);
    return Buffer.concat(parts);
}

/** Builds the program of a step with a mistake. */
export function program_with(step, mistake) {
    const text = readFileSync(join(root, 'steps', mistake.file), 'utf8');
    return program(step, new Map([[mistake.file, with_mistake(mistake, text)]]));
}

/** Builds all mistakes of a step that show in its picture; answers what the page needs to switch them on. */
export async function switches(step) {
    const base = await program(step);
    const shown = catalogue(step).filter((mistake) => mistake.picture);
    const patches = await Promise.all(shown.map(async (mistake) => patch_of(base, await program_with(step, mistake))));
    let at = 0;
    const list = shown.map(({ id, title, file, lines, shows, why, fix }, i) => {
        const entry = { id, title, file, lines, shows, why, fix, at, size: patches[i].length };
        at += entry.size;
        return entry;
    });
    return { list, patches: gzipSync(Buffer.concat(patches), { level: 9 }) };
}
