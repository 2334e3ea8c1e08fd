// What is around every page: the bar, the contents of the course and of the page, previous and next.
import { escaped } from './markdown.mjs';

const item = (page, current, base) =>
    `<li><a href="${base}${page.name}"${page.name === current ? ' aria-current="page"' : ''}>${page.label}</a></li>`;

function contents(pages, current, base) {
    const list = (part) => pages.filter((page) => page.part === part).map((page) => item(page, current, base)).join('');
    return `<nav id="contents" aria-label="Contents"><p>Chapters</p><ul class="chapters">${list('chapter')}</ul><p>Appendices</p><ul>${list('appendix')}</ul></nav>`;
}

const on_this_page = (headings) => (headings.length < 3 ? '' : `<aside class="here"><nav aria-label="On this page"><p>On this page</p><ul>${headings
    .filter(({ level }) => level === 2).map(({ id, text }) => `<li><a href="#${id}">${text}</a></li>`).join('')}</ul></nav></aside>`);

function neighbours(pages, current) {
    const at = pages.findIndex((page) => page.name === current);
    if (at < 0) return '';
    const link = (page, word, name) => (page ? `<a class="${name}" rel="${name}" href="${page.name}"><small>${word}</small>${page.label}</a>` : '<span></span>');
    return `<nav class="neighbours" aria-label="Previous and next">${link(pages[at - 1], '← Previous', 'prev')}${link(pages[at + 1], 'Next →', 'next')}</nav>`;
}

/** A whole page. `base` leads from it to the top of the site. */
export function framed({ title, name, body, pages, headings = [], scripts = [], base = '', kind = '' }) {
    return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>${escaped(title)} · Raysteps</title>
<script>try { document.documentElement.dataset.theme = localStorage.theme ?? '' } catch { }</script>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${base}katex/katex.min.css"><link rel="stylesheet" href="${base}site.css">
</head>
<body class="${kind}" data-base="${base}">
<a class="skip" href="#main">Skip to the text</a>
<header class="bar">
<a class="menu" href="#contents"><span aria-hidden="true">☰</span> Contents</a>
<a class="name" href="${base}index.html"><span class="mark" aria-hidden="true"></span>Raysteps</a>
<form role="search" class="search"><label class="unseen" for="query">Search</label><input id="query" type="search" placeholder="Search  /" autocomplete="off" disabled><ol id="results" hidden></ol></form>
<button type="button" class="theme" hidden>Dark</button>
</header>
<div class="columns">
${contents(pages, name, base)}
<main id="main" tabindex="-1"><article>
${body}
</article>
${neighbours(pages, name)}
</main>
${on_this_page(headings)}
</div>
${['minisearch.js', 'site.js', ...scripts].map((script) => `<script src="${base}${script}" defer></script>`).join('')}
</body>
</html>
`;
}
