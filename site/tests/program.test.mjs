// What the page's programs refuse, and in which words.
import assert from 'node:assert/strict';
import test from 'node:test';
import { check_live } from '../live.mjs';
import { program } from '../wasm.mjs';
import '../page/program.js';

const module = new WebAssembly.Module(await program('01_spheres'));
const refused = (...words) => {
    try {
        new Raysteps.Program(module).start(words);
    } catch (problem) {
        return problem.message;
    }
    return 'nothing was refused';
};

test('options are declared with their ranges', () => {
    const { options, program: name } = new Raysteps.Program(module).start([]);
    assert.equal(name, '01_spheres');
    const { kind, low, high, initial } = options.find((option) => option.name === 'radius');
    assert.deepEqual({ kind, low, high, initial }, { kind: 'number', low: 0.1, high: 3, initial: 1 });
    assert.deepEqual(options.find((option) => option.name === 'view').names.slice(0, 2), ['light', 'normal']);
});

test('a value out of range is refused in the words of the terminal', () => {
    assert.equal(refused('--radius', '9'), '--radius "9" is not a number from 0.1 to 3');
    assert.equal(refused('--samples', 'many'), '--samples "many" is not a whole number from 1 to 1048576');
    assert.match(refused('--view', 'norml'), /is not a choice \(did you mean normal\?\): one of light, normal/);
    assert.equal(refused('--from', '1,2'), '--from "1,2" is not three finite numbers x,y,z, as in 0,1.5,-2');
});

test('a camera without a direction is refused', () => {
    assert.equal(refused('--from', '0,0,0', '--at', '0,0,0'), '--from and --at are the same point: move one of them');
});

test('a picture too large for a page is refused', () => {
    assert.match(refused('--width', '60000', '--height', '60000'), /does not fit in a page/);
});

test('an unknown option is refused with a suggestion', () => {
    assert.equal(refused('--radios', '1'), '"--radios" is not an option of 01_spheres (did you mean --radius?)');
});

test('a live comment is refused that names no step or no option', async () => {
    const live = { file: 'docs/a.md', step: '01_spheres', options: ['radius'], words: [] };
    await check_live(live);
    await assert.rejects(check_live({ ...live, options: ['radios'] }), /docs\/a.md: <!-- live: 01_spheres ... -->: it has no option --radios/);
    await assert.rejects(check_live({ ...live, step: '09_none' }), /there is no such step/);
    await assert.rejects(check_live({ ...live, step: 'roots' }), /there is no such figure/);
    await assert.rejects(check_live({ ...live, words: ['--radius', '9'] }), /is not a number from 0.1 to 3/);
});
