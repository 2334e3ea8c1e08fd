// Live pictures in a browser: whole, equal to the terminal's, by mouse and by keyboard, with plain words when something is wrong.
import assert from 'node:assert/strict';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after } from 'node:test';
import { close_browser, no_browser, open_page, shown_picture, whole_picture } from './browser.mjs';
import { different_pixels, has_native, native_picture } from './pictures.mjs';

const skip = no_browser;
after(close_browser);

test('the command under a dragged picture makes the same picture in the terminal', { skip: skip || (has_native ? false : 'the native programs are not built') }, async () => {
    const page = await open_page('01_spheres.html');
    await whole_picture(page);
    const box = await page.locator('figure.live canvas').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    for (let i = 1; i <= 10; ++i) await page.mouse.move(box.x + box.width / 2 + 12 * i, box.y + box.height / 2 - 3 * i);
    await page.mouse.up();
    await whole_picture(page);
    const { command, ...picture } = await shown_picture(page);
    assert.match(command, /^\.\/learn run 01 .*--from -?[\d.]+,-?[\d.]+,-?[\d.]+$/);
    const native = await native_picture('01_spheres', command.split(' ').slice(3), join(mkdtempSync(join(tmpdir(), 'raysteps-')), 'dragged.png'));
    assert.equal(different_pixels(picture, native), 0);
    assert.deepEqual(page.problems, []);
});

test('every control goes to both ends by keyboard', { skip }, async () => {
    const page = await open_page('04_refraction.html');
    await whole_picture(page);
    for (const input of await page.locator('figure.live .controls input[type=range]').all())
        for (const key of ['Home', 'End']) {
            await input.focus();
            await page.keyboard.press(key);
            await page.waitForTimeout(50);
        }
    await page.locator('figure.live canvas').focus();
    for (const key of ['ArrowLeft', 'ArrowUp', '+', '-']) await page.keyboard.press(key);
    await page.getByRole('button', { name: 'Reset' }).click();
    await whole_picture(page);
    assert.deepEqual(page.problems, []);
});

test('a wrong option is told in the words of the program and the still picture stays', { skip }, async () => {
    const page = await open_page('07_antialias.html');
    await page.evaluate(() => { document.querySelector('figure.live').dataset.words = '--from 1,1,1 --at 1,1,1'; });
    await page.locator('figure.live .begin').click();
    await page.waitForSelector('figure.live[data-problem]');
    assert.match(await page.locator('figure.live .state.problem').textContent(), /--from and --at are the same point: move one of them/);
    assert.equal(await page.locator('figure.live > img').count(), 1);
});

test('without WebAssembly the still picture stays', { skip }, async () => {
    const page = await open_page('index.html');
    await page.addInitScript(() => { delete globalThis.WebAssembly; });
    await page.goto(page.url().replace('index', '03_mirror'));
    await page.evaluate(() => document.querySelector('figure.live').scrollIntoView({ behavior: 'instant' }));
    await page.waitForSelector('figure.live[data-problem]');
    assert.match(await page.locator('figure.live .state').textContent(), /^This picture stays still: this browser has no WebAssembly$/);
});

test('a puzzle names the mistake when the right line is chosen', { skip }, async () => {
    const page = await open_page('01_spheres.html');
    await page.getByRole('button', { name: 'Show me a picture' }).click();
    await page.waitForFunction(() => document.querySelector('.quiz')?.quiz?.mistake);
    await whole_picture(page, '.quiz figure.live');
    const title = await page.evaluate(() => document.querySelector('.quiz').quiz.mistake.title);
    await page.locator('.answers button', { hasText: title }).first().click();
    assert.match(await page.locator('.quiz [aria-live]').textContent(), /^Right: /);
    await page.getByRole('button', { name: 'Mend it' }).click();
    await whole_picture(page, '.quiz figure.live');
    assert.deepEqual(page.problems, []);
});

const drawn = async (figure, input, key) => {
    await input.press(key);
    return figure.locator('svg').innerHTML();
};

test('every figure that explains is drawn and answers to its controls', { skip }, async () => {
    for (const name of ['01_spheres', '02_shadows', '04_refraction', '05_mesh_bvh', '06_textures', '07_antialias']) {
        const page = await open_page(`${name}.html`);
        for (const figure of await page.locator('figure.explain').all()) {
            await figure.scrollIntoViewIfNeeded();
            await figure.locator('svg').waitFor();
            for (const input of await figure.locator('input[type=range]').all()) {
                const [low, high] = [await drawn(figure, input, 'Home'), await drawn(figure, input, 'End')];
                assert.notEqual(low, high, `${name}, ${await figure.getAttribute('data-figure')}`);
            }
        }
        assert.deepEqual(page.problems, []);
    }
});
