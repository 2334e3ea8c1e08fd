// A chapter as HTML: what weave keeps true in its Markdown becomes listings, milestones, puzzles and live pictures.
import { existsSync, readFileSync } from 'node:fs';
import { basename, dirname, join, relative, resolve } from 'node:path';
import { catalogue } from './catalogue.mjs';
import { files, linked, page_of } from './code.mjs';
import { link_terms } from './glossary.mjs';
import { escaped, highlighted, reader, without_empty_headers } from './markdown.mjs';
import { root } from './places.mjs';

const md = reader((code, language, env) =>
    (language === 'cpp' ? linked(highlighted(code, language), { step: env.step }) : highlighted(code, language)));
link_terms(md);

export const inline = (text) => md.renderInline(text, {});

/** With a capital, unless it begins with a name of one letter, as in "y grows downward". */
const sentence = (text) => (/^\w\b/.test(text) ? text : text[0].toUpperCase() + text.slice(1));

const code_link = (file) => (files.has(file) ? `<a href="${page_of(file)}">${escaped(file)}</a>` : escaped(file));

/** What a mistake looks like: right and wrong one over the other, and below it a fold with the line. */
function mistake_html(step, mistake) {
    const picture = (name, alt) => `<img src="exercises/${step}/gallery/${name}.png" alt="${alt}">`;
    const pair = `<div class="compare">${picture('right', 'right')}${picture(mistake.id, `wrong: ${escaped(mistake.title)}`)}</div>`;
    return `<figure class="mistake">${mistake.picture ? pair : ''}
<figcaption><strong>${inline(sentence(mistake.title))}.</strong> ${inline(sentence(mistake.shows))}</figcaption>
${line_html(mistake)}</figure>`;
}

const line_html = (mistake) => `<details><summary>Which line is it, and why?</summary>
<p class="source">${code_link(`steps/${mistake.file}`)}</p><pre class="diff" tabindex="0"><code>${highlighted(mistake.lines.join('\n'), 'diff')}</code></pre>
<p>${inline(sentence(mistake.why))}</p><p><em>Fix:</em> ${inline(mistake.fix)}</p></details>`;

function gallery(argument) {
    const [step, ...ids] = argument.split(' ');
    const all = catalogue(step);
    const shown = ids.map((id) => all.find((mistake) => mistake.id === id));
    return `<div class="gallery" data-step="${step}">\n${shown.map((mistake) => mistake_html(step, mistake)).join('\n')}\n</div>`;
}

const boxed = (name, title, body) => `<div class="${name}">\n<p class="source">${title}</p>\n\n${body}\n</div>\n`;

/** What becomes of each kind of region between <!-- kind: argument --> and <!-- end -->. */
const regions = {
    navigation: () => '',
    contents: () => '',
    gallery,
    listing: (argument, body) => boxed('listing', code_link(argument.split('#')[0]), body),
    diff: (argument, body) => boxed('listing', argument.split(' ').map(code_link).join(' → '), body),
    output: (argument, body) => boxed('output', `<code>${escaped(argument)}</code>`, body),
    measured: (argument, body) => boxed('output', `<code>${escaped(argument)}</code>`, body),
    milestone: (_, body) => `<div class="milestone">\n\n${body}\n</div>`,
};

/** Live pictures: {step, options, words} of "04_refraction --options ior,bubble --trace --scene weekend". */
export function live_of(argument) {
    const [step, ...words] = argument.split(/\s+/);
    const taken = (name) => {
        const at = words.indexOf(name);
        return at < 0 ? '' : words.splice(at, 2)[1];
    };
    const options = taken('--options').split(',').filter(Boolean);
    const at = words.indexOf('--trace');
    if (at >= 0) words.splice(at, 1);
    return { step, options, words, trace: at >= 0 };
}

/** A picture after a live comment becomes a figure: a step's picture, or one that explains, as in <!-- live: snell -->. */
const lively = (html) => html.replace(/<!-- live: (.*?) -->\s*<p>(<img [^>]*>)<\/p>/g, (_, argument, image) => {
    const live = live_of(argument);
    if (!/^\d/.test(live.step)) return `<figure class="explain" data-figure="${live.step}">${image}</figure>`;
    return `<figure class="live" data-step="${live.step}" data-options="${live.options.join(',')}" data-words="${escaped(live.words.join(' '))}"` +
        `${live.trace ? ' data-trace' : ''}>${image}</figure>`;
});

function size_of(file) {
    const bytes = readFileSync(file);
    if (file.endsWith('.png')) return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
    return bytes.toString('utf8', 0, 900).match(/viewBox="[\d.-]+ [\d.-]+ ([\d.]+) ([\d.]+)"/)?.slice(1).map(Math.round);
}

/** The page of a file of Markdown, or null if it has none. */
export function page_name(file) {
    const path = relative(root, file);
    if (path === 'README.md') return 'index.html';
    if (/^docs\/\w+\.md$/.test(path)) return `${basename(path, '.md')}.html`;
    return /^(accel|assets)\/README\.md$|^(CONTRIBUTING|CHANGELOG)\.md$/.test(path) ? `${path.toLowerCase().replace('/', '_').slice(0, -3)}.html` : null;
}

/** Where a link or a picture of a page leads on the site, or null if that is not part of it. */
export function place_on_site(href, from) {
    if (/^(https?:|mailto:|#)/.test(href)) return href;
    const [path, hash] = href.split('#'), file = resolve(dirname(from), decodeURI(path)), name = relative(root, file);
    const page = page_name(file) ?? (files.has(name) ? page_of(name) : /\.(png|svg)$/.test(name) && existsSync(file) ? name : null);
    return page && page + (hash ? `#${hash}` : '');
}

/** Answers {title, html, headings, pictures, lives} of a file of Markdown. */
export function chapter(file, { terms = true } = {}) {
    const source = readFileSync(file, 'utf8').replace(/\r/g, '');
    const marked = source.replace(/^<!-- (\w+): (.*?) -->\n([\s\S]*?)^<!-- end -->$/gm,
        (whole, kind, argument, body) => (regions[kind] ?? (() => whole))(argument, body));
    const step = basename(file).match(/^\d\d_\w+(?=\.md)/)?.[0];
    const env = { step: step ?? '99', terms };
    const tokens = md.parse(marked, env);
    let html = without_empty_headers(lively(md.renderer.render(tokens, md.options, env))).replace(/<!--[\s\S]*?-->/g, '');
    const pictures = new Set();
    html = html.replace(/<img ([^>]*?)src="([^"]+)"([^>]*)>/g, (_, before, src, after) => {
        const place = src.startsWith('exercises/') ? src : place_on_site(src, file);
        if (!place) throw new Error(`${relative(root, file)}: there is no picture ${src}`);
        pictures.add(place);
        const [width, height] = size_of(join(root, place));
        return `<img ${before}src="${place}"${after.replace(/ ?(width|height)="\d+"/g, '')} width="${width}" height="${height}" loading="lazy" decoding="async">`;
    });
    html = html.replace(/<a href="([^"]+)">([\s\S]*?)<\/a>/g, (_, href, text) => {
        const place = href.startsWith('code/') ? href : place_on_site(href, file);
        return place ? `<a href="${place}">${text}</a>` : text;
    });
    const headings = [...html.matchAll(/<h([23]) id="([^"]+)"[^>]*>([\s\S]*?)<\/h\1>/g)].map(([, level, id, text]) => ({ level: Number(level), id, text: text.replace(/<a [^>]*>|<\/a>/g, '') }));
    const lives = [...marked.matchAll(/^<!-- live: (.*?) -->$/gm)].map(([, argument]) => ({ file: relative(root, file), ...live_of(argument) }));
    return { title: source.match(/^# (.*)/m)[1], source, html, headings, pictures, lives };
}
