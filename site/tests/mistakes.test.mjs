// The page's mistakes: patches give back the program, and each makes the picture of the gallery.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import test from 'node:test';
import { catalogue, with_mistake } from '../catalogue.mjs';
import { patch_of, program_with } from '../mistakes.mjs';
import { root } from '../places.mjs';
import { program, steps } from '../wasm.mjs';
import { different_pixels, files_of, page_picture, read_png } from './pictures.mjs';

/** What two machines may show differently, and in how many pixels. */
const differs = {
    'fov-whole': 200, // the GNU library's tanf(36 degrees) is not the nearest float
    'pointer-to-copy': Infinity, // reads what is no longer there
};
const wanted = (process.env.RAYSTEPS_WEB_MISTAKES ?? '01,02,03,04').split(',');

test('a patch gives back what it was made from', () => {
    const base = Buffer.from(Array.from({ length: 5000 }, (_, i) => (i * i + (i >> 3)) & 255));
    const target = Buffer.concat([base.subarray(700, 2000), Buffer.from('new bytes, and more'), base.subarray(0, 900), base.subarray(4000)]);
    const patch = patch_of(base, target);
    assert.deepEqual(Buffer.from(Raysteps.patched(base, patch)), target);
    assert.ok(patch.length < 200, `${patch.length} bytes`);
});

test('a mistake that does not apply says so', () => {
    assert.throws(() => with_mistake({ id: 'none', file: 'a.h', lines: ['-int a;'] }, 'int b;\n'), /none does not apply to a.h/);
});

for (const step of steps.filter((name) => wanted.includes(name.slice(0, 2))))
    test(`${step}: every picture of the gallery is the page's`, async (t) => {
        const base = await program(step), files = await files_of(step);
        const samples = '16';
        const compare = (bytes, file) => {
            const picture = read_png(file);
            const words = ['--width', String(picture.width), '--height', String(picture.height), '--samples', samples];
            return different_pixels(page_picture(new WebAssembly.Module(bytes), files, words), picture);
        };
        await t.test('right', () => assert.equal(compare(base, join(root, 'exercises', step, 'gallery/right.png')), 0));
        const shown = catalogue(step).filter((mistake) => mistake.picture);
        await Promise.all(shown.map((mistake) => t.test(mistake.id, async () => {
            const patch = patch_of(base, await program_with(step, mistake));
            const different = compare(Raysteps.patched(base, patch), mistake.picture);
            assert.ok(different <= (differs[mistake.id] ?? 0), `${different} pixels differ`);
        })));
    });
