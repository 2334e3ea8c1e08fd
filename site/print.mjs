// Prints all chapters into one file, book.pdf beside the pages, with the system's Chromium: node site/print.mjs
import { statSync } from 'node:fs';
import { join } from 'node:path';
import { close_browser, no_browser, open_page, site } from './tests/browser.mjs';

if (no_browser) {
    console.error(`print.mjs: ${no_browser}`);
    process.exit(2);
}
const page = await open_page('book.html');
await page.evaluate(() => Promise.all([...document.images].map((image) => image.decode().catch(() => {}))));
const path = join(site, 'book.pdf');
const number = '<div style="font-size:8px;width:100%;text-align:center"><span class="pageNumber"></span></div>';
await page.pdf({ path, format: 'A4', outline: true, tagged: true, displayHeaderFooter: true, headerTemplate: '<span></span>', footerTemplate: number,
    margin: { top: '18mm', bottom: '18mm', left: '16mm', right: '16mm' } });
await close_browser();
console.log(`wrote ${path} (${(statSync(path).size / 1e6).toFixed(1)} MB)`);
