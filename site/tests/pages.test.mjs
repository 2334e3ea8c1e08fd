// The pages: weight, no other origin, every link, accessibility, phone, without JavaScript.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import test, { after } from 'node:test';
import { gzipSync } from 'node:zlib';
import { close_browser, no_browser, open_page, site } from './browser.mjs';

const built = existsSync(join(site, 'index.html')) ? false : 'the site is not built: ./learn web';
const names = built ? [] : readdirSync(site).filter((name) => name.endsWith('.html') && name !== 'book.html');
const text_of = (name) => readFileSync(join(site, name), 'utf8');
const weight = (...files) => files.reduce((sum, name) => sum + gzipSync(readFileSync(join(site, name)), { level: 9 }).length, 0);
const kib = 1024;
after(close_browser);

test('no page is heavier than its budget', { skip: built }, () => {
    for (const name of names) assert.ok(weight(name) <= 40 * kib, `${name}: ${weight(name)} bytes`);
    const own = ['site.css', 'site.js', 'program.js', 'worker.js', 'view.js', 'camera.js', 'rays.js', 'live.js', 'quiz.js', 'figures.js'];
    assert.ok(weight(...own) <= 24 * kib, `style and scripts: ${weight(...own)} bytes`);
    for (const name of readdirSync(site).filter((each) => /^(step|drawings)/.test(each))) {
        const bytes = text_of(name).match(/"([A-Za-z0-9+/=]{1000,})"/)[1].length * 3 / 4;
        assert.ok(bytes <= (name < 'step_05' ? 60 : 100) * kib, `${name}: ${bytes} bytes`);
    }
});

test('nothing is loaded from another origin', { skip: built }, () => {
    for (const name of readdirSync(site, { recursive: true }).filter((each) => /\.(html|css)$/.test(each)))
        assert.doesNotMatch(text_of(name), name.endsWith('.css') ? /url\(["']?https?:|@import/ : /<(script|img|link|iframe|source)\b[^>]* (src|href)="(https?:)?\/\//, name);
});

test('every link leads to a page and a heading that exist', { skip: built }, () => {
    const ids = new Map();
    const ids_of = (file) => {
        if (!ids.has(file)) ids.set(file, new Set([...readFileSync(file, 'utf8').matchAll(/ id="([^"]+)"/g)].map(([, id]) => id)));
        return ids.get(file);
    };
    for (const name of [...names, 'book.html', 'code/steps-01_spheres-sphere.h.html'])
        for (const [, href] of text_of(name).matchAll(/ href="([^"]+)"/g)) {
            if (/^(https?|mailto|data):/.test(href)) continue;
            const [path, hash] = href.split('#'), file = path ? join(site, dirname(name), path) : join(site, name);
            assert.ok(existsSync(file), `${name}: ${href}`);
            if (hash) assert.ok(ids_of(file).has(decodeURIComponent(hash)), `${name}: ${href}`);
        }
});

test('axe finds no violation on any page in light and in dark', { skip: no_browser }, async (t) => {
    const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
    for (const colorScheme of ['light', 'dark'])
        for (const name of [...names, 'code/steps-01_spheres-sphere.h.html'])
            await t.test(`${name} ${colorScheme}`, async () => {
                const page = await open_page(name, { colorScheme });
                await page.evaluate(axe);
                const { violations } = await page.evaluate(() => axe.run(document, { resultTypes: ['violations'] }));
                assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.length}, first ${nodes[0].target}`), []);
                await page.context().close();
            });
});

test('no page scrolls sideways on a phone', { skip: no_browser }, async () => {
    const page = await open_page('index.html', { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
    for (const name of names) {
        await page.goto(`file://${site}/${name}`);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), name);
    }
});

test('without JavaScript a page has its text and pictures and its contents', { skip: no_browser }, async () => {
    const page = await open_page('01_spheres.html', { javaScriptEnabled: false, viewport: { width: 390, height: 844 } });
    assert.equal(await page.locator('figure.live > img').count(), 1);
    assert.equal(await page.locator('.compare img').count() > 10, true);
    await page.locator('.menu').click();
    assert.ok(await page.locator('#contents').isVisible());
});

test('search finds a section by the beginning of a word', { skip: no_browser }, async () => {
    const page = await open_page('01_spheres.html');
    await page.fill('#query', 'total internal reflec');
    await page.waitForSelector('#results a');
    assert.match(await page.locator('#results a').first().getAttribute('href'), /^04_refraction\.html#/);
    assert.deepEqual(page.problems, []);
});

test('a term is explained where it stands', { skip: no_browser }, async () => {
    const page = await open_page('01_spheres.html');
    await page.locator('a.term').first().focus();
    await page.waitForSelector('#told b');
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('#told').count(), 0);
});
