// The terms of the glossary, and links to them from the first place in each section where they occur.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { slug } from './markdown.mjs';
import { root } from './places.mjs';

const row = /^\| ([^`|]+?) \| (.+?) \| (\[.*) \|$/gm;
const [first_table] = readFileSync(join(root, 'docs/glossary.md'), 'utf8').split(/^## /m);

/** The terms: {term, id, text}, where the text is Markdown. */
export const terms = [...first_table.matchAll(row)].map(([, term, text]) => ({ term, id: `term-${slug(term)}`, text }));

const by_word = new Map(terms.map((entry) => [entry.term.toLowerCase(), entry]));
const too_common = new Set(['depth', 'filter', 'bin', 'light', 'noise', 'sample']);
const words = [...by_word.keys()].filter((word) => !too_common.has(word) && !word.includes(',')).sort((a, b) => b.length - a.length);
const any_term = new RegExp(`(?<![\\w-])(${words.map((word) => word.replace(/[.*+?^${}()|[\]\\']/g, '\\$&')).join('|')})(?![\\w-])`, 'gi');

/** A rule for markdown-it: marks terms in running text, each once in a section. */
export function link_terms(md) {
    md.core.ruler.push('terms', (state) => {
        if (!state.env.terms) return;
        let met = new Set(), in_heading = false, in_table = false;
        for (const token of state.tokens) {
            if (token.type === 'heading_open') {
                in_heading = true;
                if (token.tag === 'h2') met = new Set();
            } else if (token.type === 'heading_close') in_heading = false;
            else if (token.type === 'table_open') in_table = true;
            else if (token.type === 'table_close') in_table = false;
            else if (token.type === 'inline' && !in_heading && !in_table) mark(token, met, state);
        }
    });
}

function mark(inline, met, state) {
    let in_link = 0;
    inline.children = inline.children.flatMap((token) => {
        in_link += token.type === 'link_open' ? 1 : token.type === 'link_close' ? -1 : 0;
        if (token.type !== 'text' || in_link) return [token];
        return token.content.split(any_term).map((text) => {
            const entry = by_word.get(text.toLowerCase());
            const known = entry && !met.has(entry.id);
            if (known) met.add(entry.id);
            const piece = new state.Token(known ? 'html_inline' : 'text', '', 0);
            piece.content = known ? `<a class="term" href="glossary.html#${entry.id}">${text}</a>` : text;
            return piece;
        });
    });
}
