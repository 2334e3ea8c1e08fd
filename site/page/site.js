// Theme, contents, search, terms, sliders across pictures. The pages are whole without it.
(() => {
    const root = document.documentElement, base = document.body.dataset.base;
    const all = (selector, within = document) => [...within.querySelectorAll(selector)];
    const made = (tag, fields = {}, ...children) => {
        const element = Object.assign(document.createElement(tag), fields);
        element.append(...children);
        return element;
    };
    const loading = {};
    /** Loads a script once; pages opened as files may not fetch anything else. */
    const script = (name) => (loading[name] ??= new Promise((done, fail) => {
        document.head.append(made('script', { src: base + name, onload: done, onerror: () => fail(new Error(`${name} is missing`)) }));
    }));
    globalThis.Page = { all, made, script };

    // Light and dark.
    const theme = document.querySelector('.theme'), system = matchMedia('(prefers-color-scheme: dark)');
    const is_dark = () => (root.dataset.theme ? root.dataset.theme === 'dark' : system.matches);
    const name_theme = () => { theme.textContent = is_dark() ? 'Light' : 'Dark'; };
    theme.hidden = false;
    theme.onclick = () => {
        root.dataset.theme = is_dark() ? 'light' : 'dark';
        try { localStorage.theme = root.dataset.theme; } catch { /* pages opened as files may have no storage */ }
        name_theme();
    };
    system.addEventListener('change', name_theme);
    name_theme();

    // The contents on a phone.
    const menu = document.querySelector('.menu'), contents = document.getElementById('contents');
    menu.setAttribute('role', 'button');
    menu.setAttribute('aria-expanded', 'false');
    menu.onclick = (event) => {
        event.preventDefault();
        menu.setAttribute('aria-expanded', String(contents.classList.toggle('open')));
        scrollTo({ top: 0 });
    };

    // Where on the page the reader is.
    const here = new Map(all('.here a').map((link) => [decodeURIComponent(link.hash.slice(1)), link]));
    if (here.size) {
        const headings = all('h2[id]').filter((heading) => here.has(heading.id));
        let waiting = false;
        const mark = () => {
            waiting = false;
            const current = headings.findLast((heading) => heading.getBoundingClientRect().top < 140) ?? headings[0];
            here.forEach((link, id) => link.classList.toggle('current', id === current?.id));
        };
        addEventListener('scroll', () => { if (!waiting) { waiting = true; requestAnimationFrame(mark); } }, { passive: true });
        mark();
    }

    // Search.
    const query = document.getElementById('query'), results = document.getElementById('results');
    let index;
    const load_index = () => (index ??= script('search_index.js').then(() => MiniSearch.loadJSON(RAYSTEPS_INDEX.index, RAYSTEPS_INDEX.options)));
    const link_to = (hit) => made('li', {}, made('a', { href: `${base}${hit.page}#${hit.hash}` }, hit.heading, made('small', { textContent: hit.title })));
    query.disabled = false;
    query.onfocus = load_index;
    query.oninput = async () => {
        const found = (await load_index()).search(query.value, { prefix: true, fuzzy: 0.15, boost: { heading: 4, title: 2 } }).slice(0, 12);
        results.replaceChildren(...found.map(link_to));
        results.hidden = !found.length;
    };
    query.form.onsubmit = (event) => { event.preventDefault(); results.querySelector('a')?.click(); };
    addEventListener('keydown', (event) => {
        if (event.key === '/' && !/INPUT|TEXTAREA|SELECT/.test(event.target.tagName)) { event.preventDefault(); query.focus(); }
        if (event.key === 'Escape') { results.hidden = true; forget(); }
    });
    addEventListener('click', (event) => { if (!query.form.contains(event.target)) results.hidden = true; });

    // Terms, explained where they stand.
    let told;
    const forget = () => { told?.remove(); told = null; };
    async function tell(link) {
        await script('terms.js');
        forget();
        const box = link.getBoundingClientRect();
        told = made('div', { id: 'told', innerHTML: RAYSTEPS_TERMS[link.hash.slice(1)] ?? '' });
        told.setAttribute('role', 'tooltip');
        document.body.append(told);
        link.setAttribute('aria-describedby', 'told');
        const left = Math.max(8, Math.min(box.left, innerWidth - told.offsetWidth - 8));
        const below = box.bottom + told.offsetHeight + 12 < innerHeight;
        told.style.left = `${left + scrollX}px`;
        told.style.top = `${(below ? box.bottom + 8 : box.top - told.offsetHeight - 8) + scrollY}px`;
    }
    for (const link of all('a.term')) {
        link.onmouseenter = link.onfocus = () => tell(link);
        link.onmouseleave = link.onblur = forget;
    }

    // A slider across right and wrong.
    Page.slide = (compare, left = 'right', right = 'wrong') => {
        const input = made('input', { type: 'range', min: 0, max: 100, value: 50 });
        input.setAttribute('aria-label', `how much of the picture is ${left}`);
        input.oninput = () => compare.style.setProperty('--cut', `${input.value}%`);
        compare.append(made('i', { className: 'left', textContent: left }), made('i', { className: 'right', textContent: right }), input);
        compare.classList.add('sliding');
    };
    all('.compare').forEach((compare) => Page.slide(compare));

    for (const heading of all('article :is(h2, h3)[id]')) {
        const anchor = made('a', { className: 'anchor', href: `#${heading.id}`, textContent: '#' });
        anchor.setAttribute('aria-label', `link to "${heading.textContent}"`);
        heading.append(anchor);
    }
})();
