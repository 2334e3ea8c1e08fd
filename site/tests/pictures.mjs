// What the tests need to compare pictures: the pixels of a PNG, those of a program of the page, native programs.
import { execFile } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { inflateSync } from 'node:zlib';
import { root } from '../places.mjs';
import '../page/program.js';

export { files_of } from '../live.mjs';

const run = promisify(execFile);

/** Programs for any machine of this architecture; -march=native would change last bits. */
export const native = process.env.RAYSTEPS_NATIVE_BUILD ?? join(root, 'build/web/native');
process.env.RAYSTEPS_BUILD ??= native;
export const has_native = existsSync(join(native, 'bin/08_indirect'));

function undone(type, byte, left, up, corner) {
    const guess = left + up - corner, nearness = [left, up, corner].map((each) => Math.abs(guess - each));
    const paeth = nearness[0] <= nearness[1] && nearness[0] <= nearness[2] ? left : nearness[1] <= nearness[2] ? up : corner;
    return (byte + [0, left, up, (left + up) >> 1, paeth][type]) & 255;
}

/** {width, height, rgb} of an 8-bit RGB PNG that is not interlaced. */
export function read_png(file) {
    const bytes = readFileSync(file), parts = [];
    for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at))
        if (bytes.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
    const width = bytes.readUInt32BE(16), height = bytes.readUInt32BE(20), row = 3 * width;
    if (bytes[24] !== 8 || bytes[25] !== 2) throw new Error(`${file} is not an 8-bit RGB picture`);
    const raw = inflateSync(Buffer.concat(parts)), rgb = new Uint8Array(row * height);
    for (let y = 0; y < height; ++y)
        for (let i = 0; i < row; ++i) {
            const at = y * row + i, left = i < 3 ? 0 : rgb[at - 3], up = y ? rgb[at - row] : 0, corner = y && i >= 3 ? rgb[at - row - 3] : 0;
            rgb[at] = undone(raw[y * (row + 1)], raw[y * (row + 1) + 1 + i], left, up, corner);
        }
    return { width, height, rgb };
}

/** What a program of the page renders: {width, height, rgb, rays}. */
export function page_picture(module, files, words) {
    const page = new Raysteps.Program(module, files);
    const { options } = page.start(words);
    const value = (name) => {
        const at = words.indexOf(`--${name}`);
        return at < 0 ? options.find((option) => option.name === name).initial : Number(words[at + 1]);
    };
    const width = value('width'), height = value('height'), rgb = new Uint8Array(3 * width * height);
    for (let y = 0; y < height; y += 16)
        for (let x = 0; x < width; x += 16) {
            const x1 = Math.min(width, x + 16), y1 = Math.min(height, y + 16);
            const rgba = page.add_samples(x, y, x1, y1, 0, value('samples'));
            for (let i = 0; i < rgba.length / 4; ++i) {
                const at = 3 * ((y + Math.floor(i / (x1 - x))) * width + x + i % (x1 - x));
                rgb.set(rgba.subarray(4 * i, 4 * i + 3), at);
            }
        }
    return { width, height, rgb, rays: page.rays() };
}

/** What the native program renders with the same words; `file` is where. */
export async function native_picture(step, words, file) {
    await run(join(native, 'bin', step), [...words, '--quiet', '--out', file], { env: { ...process.env, RAYSTEPS_ASSETS: join(native, 'assets') } });
    return read_png(file);
}

/** The number of pixels that differ. */
export function different_pixels(a, b) {
    if (a.width !== b.width || a.height !== b.height) return Infinity;
    let count = 0;
    for (let i = 0; i < a.rgb.length; i += 3) count += [0, 1, 2].some((channel) => a.rgb[i + channel] !== b.rgb[i + channel]);
    return count;
}
