// Builds the web edition: node site/build.mjs [--out FOLDER] [--mistakes 01,02|none|all] [--pages-only]
import { copyFileSync, cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { parseArgs } from 'node:util';
import MiniSearch from 'minisearch';
import { chapter, inline, page_name } from './chapter.mjs';
import { code_page, files, page_of } from './code.mjs';
import { framed } from './frame.mjs';
import { terms } from './glossary.mjs';
import { check_live, write_scripts } from './live.mjs';
import { escaped } from './markdown.mjs';
import { here, root } from './places.mjs';
import { steps } from './wasm.mjs';

const { values: wanted } = parseArgs({ options: {
    out: { type: 'string', default: join(root, 'build/web/site') },
    mistakes: { type: 'string', default: process.env.RAYSTEPS_WEB_MISTAKES ?? '01,02,03,04' }, // all: ten minutes more
    'pages-only': { type: 'boolean', default: false },
} });
const { out } = wanted;
const with_puzzles = steps.filter((step) => wanted.mistakes === 'all' || wanted.mistakes.split(',').includes(step.slice(0, 2)));

const sources = [
    ...readdirSync(join(root, 'docs')).filter((name) => name.endsWith('.md')).sort().map((name) => join(root, 'docs', name)),
    ...['accel/README.md', 'CONTRIBUTING.md', 'CHANGELOG.md'].map((name) => join(root, name)),
];

const label = (title) => inline(title).replace(/^(\d\d) /, '<b>$1</b> ');

function read_pages() {
    const pages = sources.map((file) => {
        const step = steps.find((name) => file.endsWith(`/${name}.md`));
        const name = page_name(file);
        return { name, file, step, part: step ? 'chapter' : file.includes('/docs/') ? 'appendix' : 'other',
            ...chapter(file, { terms: name !== 'glossary.html' && !/log|contrib/.test(name) }) };
    });
    for (const page of pages) page.label = label(page.title);
    return [...pages.filter((page) => page.step), ...pages.filter((page) => !page.step)];
}

const written = (name, text) => {
    mkdirSync(dirname(join(out, name)), { recursive: true });
    writeFileSync(join(out, name), text);
};

/** The README's table of chapters as cards, in place of the contact sheet. */
function front_page(pages) {
    const { html, pictures, headings } = chapter(join(root, 'README.md'), { terms: false });
    const cards = [...html.matchAll(/<tr>\s*<td><a href="(\d\d_\w+\.html)">(<img [^>]*>)<\/a><\/td>\s*<td><strong>.*?<\/strong> — (.*?)<br>\s*([\s\S]*?)<\/td>\s*<\/tr>/g)]
        .map(([, href, image, question, text]) => `<li><a class="card" href="${href}">${image.replace(/alt="[^"]*"/, 'alt=""')}<b>${pages.find((page) => page.name === href).label}</b><span>${question}</span></a><p>${text}</p></li>`);
    const table = /<div class="table"[^>]*><table>[\s\S]*?<\/table><\/div>/;
    const chapters = /<h2 id="the-eight-chapters"[\s\S]*?(?=<h2 )/;
    const first = html.match(chapters)[0].replace(table, `<ul class="cards">${cards.join('\n')}</ul>`);
    const sheet = /<p><img [^>]*contact_sheet[^>]*><\/p>/;
    return { title: 'A path tracer in eight steps', html: html.replace(chapters, '').replace(sheet, first), pictures, headings };
}

/** Ids of the glossary's rows, so that terms can be linked to. */
function with_term_ids(html) {
    const ids = terms.map(({ id }) => id);
    return html.replace(/<tr>\s*<td>/g, (row) => (ids.length ? row.replace('<tr>', `<tr id="${ids.shift()}">`) : row));
}

function write_search(pages) {
    const fields = ['heading', 'text', 'title'], storeFields = ['page', 'title', 'heading', 'hash'];
    const index = new MiniSearch({ fields, storeFields });
    const plain = (html) => html.replace(/<annotation[\s\S]*?<\/annotation>|<[^>]*>/g, ' ').replace(/&\w+;/g, ' ').replace(/\s+/g, ' ').trim();
    let id = 0;
    for (const page of pages)
        for (const part of page.html.split(/(?=<h[123] )/)) {
            const [, hash = '', heading = page.title] = part.match(/^<h[123] id="([^"]*)"[^>]*>([\s\S]*?)<\/h/) ?? [];
            index.add({ id: ++id, page: page.name, title: page.title, hash, heading: plain(heading), text: plain(part) });
        }
    written('search_index.js', `RAYSTEPS_INDEX = ${JSON.stringify({ index: JSON.stringify(index), options: { fields, storeFields } })};\n`);
    return id;
}

/** All chapters as one page, to print: ids get the page's name in front. */
function book(pages) {
    const printed = pages.filter((page) => !/change|contrib/.test(page.name));
    const names = new Set(printed.map((page) => page.name));
    const sections = printed.map((page) => {
        const own = page.name.replace('.html', '');
        return `<section class="chapter" id="${own}">${page.html.replace(/ id="([^"]+)"/g, ` id="${own}--$1"`)
            .replace(/href="#([^"]+)"/g, `href="#${own}--$1"`)
            .replace(/href="(\w+)\.html#([^"]+)"/g, (all, name, id) => (names.has(`${name}.html`) ? `href="#${name}--${id}"` : all))
            .replace(/href="(\w+\.html)"/g, (all, name) => (names.has(name) ? `href="#${name.replace('.html', '')}"` : all))
            .replaceAll(' loading="lazy"', '').replaceAll('<details>', '<details open>')}</section>`;
    });
    return sections.join('\n');
}

function copy_library_files() {
    const modules = join(here, 'node_modules');
    copyFileSync(join(modules, 'minisearch/dist/umd/index.js'), join(out, 'minisearch.js'));
    const style = readFileSync(join(modules, 'katex/dist/katex.min.css'), 'utf8');
    written('katex/katex.min.css', style.replace(/,url\([^)]*\.(woff|ttf)\) format\("(woff|truetype)"\)/g, ''));
    const fonts = join(modules, 'katex/dist/fonts');
    cpSync(fonts, join(out, 'katex/fonts'), { recursive: true, filter: (name) => name === fonts || name.endsWith('.woff2') });
    for (const name of readdirSync(join(here, 'page'))) copyFileSync(join(here, 'page', name), join(out, name));
}

const live_scripts = ['program.js', 'worker.js', 'view.js', 'camera.js', 'rays.js', 'live.js', 'quiz.js', 'figures.js'];

function write_pages(pages) {
    const front = front_page(pages);
    for (const page of pages) {
        if (page.name === 'glossary.html') page.html = with_term_ids(page.html);
        const body = with_puzzles.includes(page.step) ? page.html.replace(/(<div class="gallery"[\s\S]*<\/figure>\n<\/div>)/, `$1\n<section class="quiz" data-step="${page.step}"></section>`) : page.html;
        written(page.name, framed({ ...page, body, pages, scripts: page.step ? live_scripts : [], kind: page.part }));
    }
    written('index.html', framed({ ...front, name: 'index.html', body: front.html, pages, kind: 'front' }));
    for (const file of files)
        written(page_of(file), framed({ title: file, name: '', body: code_page(file), pages, base: '../', kind: 'code' }));
    written('book.html', framed({ title: 'The book', name: '', body: book(pages), pages: [], kind: 'book' }));
    for (const picture of new Set([...pages, front].flatMap((page) => [...page.pictures]))) {
        mkdirSync(dirname(join(out, picture)), { recursive: true });
        copyFileSync(join(root, picture), join(out, picture));
    }
    for (const step of steps)
        cpSync(join(root, 'exercises', step, 'gallery'), join(out, 'exercises', step, 'gallery'), { recursive: true });
    written('terms.js', `RAYSTEPS_TERMS = ${JSON.stringify(Object.fromEntries(terms.map(({ term, id, text }) => [id, `<b>${escaped(term)}</b> ${inline(text)}`])))};\n`);
    copy_library_files();
    return `${pages.length} pages, ${files.size} pages of code, ${write_search(pages)} sections in the index`;
}

mkdirSync(out, { recursive: true });
for (const name of ['code', 'docs', 'exercises', 'assets']) rmSync(join(out, name), { recursive: true, force: true });
const pages = read_pages();
console.log(write_pages(pages));
if (!wanted['pages-only']) {
    for (const live of pages.flatMap((page) => page.lives)) await check_live(live);
    await write_scripts(out, with_puzzles, console.log);
}
console.log(`wrote ${join(out, 'index.html')}`);
