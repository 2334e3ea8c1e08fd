// The code as pages of their own, and links to them from the names in listings.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { escaped, highlighted } from './markdown.mjs';
import { root } from './places.mjs';

const rooms = ['steps', 'common', 'accel', 'assets', 'tests', 'tools', 'exercises'];
const listed = (room) => readdirSync(join(root, room), { recursive: true }).map((name) => `${room}/${name}`)
    .filter((name) => /\.(h|cpp)$/.test(name) || /exercises\/\d\d_\w+\/\w+\.md$/.test(name));

/** All files that have a page. */
export const files = new Set([...rooms.flatMap(listed), 'learn', 'CMakeLists.txt']);

export const page_of = (file) => `code/${file.replaceAll('/', '-')}.html`;

const declaration = /^(?:struct|class|enum class|concept|using) (\w+)|^(?:\w[\w:<>,&* ]*[ &*>])(\w+)\((?!.*;\s*$)/;

/** Where names are declared: name to [{file, line}], in the order of the steps. */
export const names = new Map();
for (const file of [...files].filter((name) => /^(steps|common|accel)\/.*\.h$/.test(name) && !name.includes('/bench/')).sort())
    readFileSync(join(root, file), 'utf8').split('\n').forEach((text, i) => {
        const found = text.match(declaration), name = found?.[1] ?? found?.[2];
        if (!name || name === 'main') return;
        names.set(name, [...(names.get(name) ?? []), { file, line: i + 1 }]);
    });

/** Where a name is declared for the reader of a chapter: in the file shown, or in the newest step so far. */
function place_of(name, step, shown) {
    const all = names.get(name);
    if (!all) return undefined;
    return all.find(({ file }) => file === shown)
        ?? all.filter(({ file }) => !file.startsWith('steps/') || file.slice(6, 8) <= step.slice(0, 2)).at(-1);
}

/** Links the first mention of each name in highlighted code; strings and comments stay as they are. */
export function linked(html, { step = '99', shown = '', base = '' } = {}) {
    const met = new Set();
    let quiet = 0;
    return html.split(/(<[^>]*>)/).map((part) => {
        if (part.startsWith('<span')) quiet += quiet || /comment|string|meta/.test(part) ? 1 : 0;
        else if (part === '</span>') quiet -= quiet ? 1 : 0;
        if (part.startsWith('<') || quiet) return part;
        return part.replace(/[A-Za-z_]\w+/g, (name) => {
            const place = met.has(name) ? undefined : place_of(name, step, shown);
            if (!place) return name;
            met.add(name);
            return `<a href="${base}${page_of(place.file)}#L${place.line}">${name}</a>`;
        });
    }).join('');
}

/** The body of a file's page. */
export function code_page(file) {
    const text = readFileSync(join(root, file), 'utf8');
    const language = /\.(h|cpp)$/.test(file) ? 'cpp' : file === 'learn' ? 'bash' : '';
    const step = file.match(/^(?:steps|tests)\/(\d\d_)/)?.[1];
    const html = linked(highlighted(text, language), { step, shown: file, base: '../' });
    const lines = html.replace(/\n$/, '').split('\n').map((line, i) => `<span class="line" id="L${i + 1}">${line || ' '}</span>`);
    return `<h1 class="file"><code>${escaped(file)}</code></h1><pre class="cpp whole" tabindex="0"><code>${lines.join('\n')}</code></pre>`;
}
