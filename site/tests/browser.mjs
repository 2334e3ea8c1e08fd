// A browser for the tests, or the reason why there is none.
import { execFileSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { root } from '../places.mjs';

export const site = process.env.RAYSTEPS_SITE ?? join(root, 'build/web/site');

function found_browser() {
    for (const name of ['chromium', 'chromium-browser', 'google-chrome'])
        try {
            return execFileSync('sh', ['-c', `command -v ${name}`]).toString().trim();
        } catch { /* the next one */ }
    return null;
}

const executable = process.env.CHROMIUM ?? found_browser();
const playwright = await import('playwright-core').catch(() => null);

/** False, or why the tests in a browser are skipped. */
export const no_browser = !existsSync(join(site, 'index.html')) ? 'the site is not built: ./learn web'
    : !executable ? 'there is no Chromium' : !playwright ? 'there is no playwright-core: npm ci --prefix site' : false;

let browser;
export async function open_page(name, options = {}) {
    browser ??= await playwright.chromium.launch({ executablePath: executable, args: ['--no-sandbox', '--disable-gpu'] });
    const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
    const page = await context.newPage();
    page.problems = [];
    page.on('pageerror', (error) => page.problems.push(error.message));
    page.on('console', (message) => { if (message.type() === 'error') page.problems.push(message.text()); });
    page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) page.problems.push(`asks for ${request.url()}`); });
    await page.goto(`file://${site}/${name}`);
    return page;
}

export const close_browser = () => browser?.close();

/** Scrolls a figure into view and waits until all samples are in. */
export async function whole_picture(page, selector = 'figure.live') {
    await page.evaluate((which) => document.querySelector(which).scrollIntoView({ block: 'center', behavior: 'instant' }), selector);
    const begin = page.locator(`${selector} .begin`);
    if (await begin.count()) await begin.first().click();
    await page.waitForFunction((which) => {
        const figure = document.querySelector(which);
        return figure.dataset.problem ?? (figure.dataset.whole && figure.dataset.whole === figure.querySelector('.command code').textContent);
    }, selector, { timeout: 120000 });
}

/** The pixels and the command line of a live picture. */
export const shown_picture = (page, selector = 'figure.live') => page.evaluate((which) => {
    const figure = document.querySelector(which), canvas = figure.querySelector('canvas');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return { width: canvas.width, height: canvas.height, rgb: [...data.filter((_, i) => i % 4 < 3)], command: figure.querySelector('.command code').textContent };
}, selector);
