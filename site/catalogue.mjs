// The known mistakes of a step, as exercises/*/mistakes.md has them.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './places.mjs';

/** Answers the mistakes of a step: {id, title, file, lines, diff, shows, why, fix, picture}. */
export function catalogue(step) {
    const folder = join(root, 'exercises', step);
    const text = readFileSync(join(folder, 'mistakes.md'), 'utf8');
    return text.split(/^## /m).slice(1).map((entry) => {
        const [, id, title] = entry.match(/^([a-z0-9-]+): (.*)/);
        const [file, ...lines] = entry.match(/```diff\n([\s\S]*?)\n```/)[1].split('\n');
        const field = (name) => entry.match(new RegExp(`^\\* ${name}: (.*(?:\\n  .*)*)`, 'm'))[1].replace(/\s+/g, ' ').trim();
        const picture = join(folder, 'gallery', `${id}.png`);
        return { id, title, file, lines, shows: field('Shows'), why: field('Why'), fix: field('Fix'),
            picture: existsSync(picture) ? picture : null };
    });
}

/** The text of a header with a mistake in it. Blanks at both ends of a line do not count. */
export function with_mistake(mistake, text) {
    const lines = text.split('\n');
    const wanted = mistake.lines.filter((line) => line[0] !== '+').map((line) => line.slice(1).trim());
    const place = lines.findIndex((_, at) => wanted.every((line, i) => lines[at + i]?.trim() === line));
    if (place < 0) throw new Error(`${mistake.id} does not apply to ${mistake.file}`);
    let old = place;
    const fresh = [];
    for (const line of mistake.lines) {
        if (line[0] === '+') fresh.push(line.slice(1));
        else if (line[0] === '-') ++old;
        else fresh.push(lines[old++]);
    }
    return [...lines.slice(0, place), ...fresh, ...lines.slice(old)].join('\n');
}
