// The rays of a clicked pixel are told as ./learn trace tells them, line by line, and each is drawn.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { promisify } from 'node:util';
import { patch_of } from '../mistakes.mjs';
import { traced_program } from '../traces.mjs';
import { program } from '../wasm.mjs';
import { native } from './pictures.mjs';

const run = promisify(execFile);
const size = ['--width', '320', '--height', '200'];
const pixels = [[10, 10], [60, 100], [100, 120], [130, 60], [160, 100], [180, 90], [200, 150], [240, 120], [300, 110], [310, 190]];
const folder = mkdtempSync(join(tmpdir(), 'raysteps-'));

function told(module, x, y) {
    let text = '', rays = 0;
    const page = new Raysteps.Program(module, {}, (more) => { text += more; });
    page.ray = () => { ++rays; };
    page.start([...size, '--crop', `${x},${y},${x + 1},${y + 1}`]);
    page.add_samples(x, y, x + 1, y + 1, 0, 1);
    return { text, rays };
}

for (const step of ['02_shadows', '04_refraction']) {
    const tool = join(native, 'bin', `trace_${step}`);
    test(`${step}: ten pixels are told as in the terminal`, { skip: existsSync(tool) ? false : 'the native programs are not built' }, async () => {
        const module = new WebAssembly.Module(await traced_program(step));
        for (const [x, y] of pixels) {
            const { text, rays } = told(module, x, y);
            const words = [...size, '--crop', `${x},${y},${x + 1},${y + 1}`, '--threads', '1', '--quiet', '--out', join(folder, 'pixel')];
            const { stdout } = await run(tool, words);
            assert.equal(text, stdout.replace(/^wrote .*\n/gm, ''), `pixel ${x},${y}`);
            assert.equal(rays, text.match(/^ *(shadow )?ray from/gm).length);
        }
    });
}

test('the program that tells rays is a small patch of the step', async () => {
    const right = await program('04_refraction'), told_by = await traced_program('04_refraction');
    const patch = patch_of(right, told_by);
    assert.deepEqual(Buffer.from(Raysteps.patched(right, patch)), told_by);
    assert.ok(patch.length < 40000, `${patch.length} bytes`);
});
