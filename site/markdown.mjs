// Markdown as the chapters use it, to HTML: with mathematics set ahead, footnotes, and headings that can be linked to.
import hljs from 'highlight.js/lib/core';
import bash from 'highlight.js/lib/languages/bash';
import cpp from 'highlight.js/lib/languages/cpp';
import diff from 'highlight.js/lib/languages/diff';
import katex from 'katex';
import MarkdownIt from 'markdown-it';
import footnote from 'markdown-it-footnote';

for (const [name, grammar] of Object.entries({ bash, cpp, diff })) hljs.registerLanguage(name, grammar);
hljs.registerAliases(['sh'], { languageName: 'bash' });

export const escaped = (text) => text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

/** The id of a heading, as a code host makes it. */
export const slug = (text) => text.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').trim().replace(/ /g, '-');

export const highlighted = (code, language) =>
    (hljs.getLanguage(language) ? hljs.highlight(code, { language }).value : escaped(code));

const math = (tex, displayMode) => katex.renderToString(tex, { displayMode, throwOnError: true, strict: 'ignore' });

/** $`...`$ within a line. */
function inline_math(state, silent) {
    if (!state.src.startsWith('$`', state.pos)) return false;
    const end = state.src.indexOf('`$', state.pos + 2);
    if (end < 0) return false;
    if (!silent) state.push('math', '', 0).content = state.src.slice(state.pos + 2, end);
    state.pos = end + 2;
    return true;
}

function number_headings(state) {
    const seen = new Map();
    state.tokens.forEach((token, i) => {
        if (token.type !== 'heading_open') return;
        const id = slug(state.tokens[i + 1].content), count = seen.get(id) ?? 0;
        seen.set(id, count + 1);
        token.attrSet('id', count ? `${id}-${count}` : id);
    });
}

/** A reader of Markdown; `code` makes HTML of the code in a block. */
export function reader(code = highlighted) {
    const md = new MarkdownIt({ html: true }).use(footnote);
    md.inline.ruler.before('escape', 'math', inline_math);
    md.core.ruler.push('ids', number_headings);
    md.renderer.rules.math = (tokens, i) => math(tokens[i].content, false);
    md.renderer.rules.fence = (tokens, i, _, env) => {
        const { content, info } = tokens[i], language = info.trim();
        if (language === 'math') return `<div class="math" tabindex="0">${math(content, true)}</div>\n`;
        return `<pre class="${language || 'text'}" tabindex="0"><code>${code(content, language, env)}</code></pre>\n`;
    };
    md.renderer.rules.code_block = (tokens, i) => `<pre class="text" tabindex="0"><code>${escaped(tokens[i].content)}</code></pre>\n`;
    let tables = 0;
    md.renderer.rules.table_open = () => `<div class="table" tabindex="0" role="region" aria-label="Table ${++tables}"><table>\n`;
    md.renderer.rules.table_close = () => '</table></div>\n';
    return md;
}

/** A table's header that has nothing to say is left out; one that is a formula alone is no header for a screen reader. */
export const without_empty_headers = (html) => html.replace(/<thead>\s*<tr>\s*(<th[^>]*><\/th>\s*)+<\/tr>\s*<\/thead>/g, '')
    .replace(/<th([^>]*)>(<span class="katex">(?:(?!<\/?th)[\s\S])*)?<\/th>/g, '<td class="head"$1>$2</td>');
