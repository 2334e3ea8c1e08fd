// The page's programs make the same bytes as the terminal's: all steps, all scenes, all filters.
import assert from 'node:assert/strict';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { program, steps } from '../wasm.mjs';
import { different_pixels, files_of, has_native, native_picture, page_picture } from './pictures.mjs';

const folder = mkdtempSync(join(tmpdir(), 'raysteps-'));
const size = ['--width', '320', '--height', '200', '--samples', '4'];
const more = {
    '05_mesh_bvh': [['--accel', 'wide']],
    '07_antialias': [['--filter', 'box'], ['--filter', 'tent']],
    '08_indirect': ['furnace', 'cornell', 'weekend', 'cat'].map((scene) => ['--scene', scene]),
};
const allowed = { '07_antialias': 5 }; // with the Gaussian, whose logarithm two libraries round differently

for (const step of steps)
    test(`${step}: the page makes the picture of the terminal`, { skip: has_native ? false : 'the native programs are not built' }, async (t) => {
        const module = new WebAssembly.Module(await program(step)), files = await files_of(step);
        for (const [i, words] of [[], ...(more[step] ?? [])].entries())
            await t.test(words.join(' ') || 'as it is', async () => {
                const native = await native_picture(step, [...size, ...words], join(folder, `${step}_${i}.png`));
                const different = different_pixels(page_picture(module, files, [...size, ...words]), native);
                assert.ok(different <= (words.length ? 0 : allowed[step] ?? 0), `${different} pixels differ`);
            });
    });

test('a changed command line makes the same picture in the page and in the terminal', { skip: has_native ? false : 'the native programs are not built' }, async () => {
    const words = [...size, '--radius', '1.4', '--from', '-2.722,2.105,4.625', '--view', 'normal'];
    const native = await native_picture('01_spheres', words, join(folder, 'changed.png'));
    assert.equal(different_pixels(page_picture(new WebAssembly.Module(await program('01_spheres')), {}, words), native), 0);
});
