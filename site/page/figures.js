// Figures that explain: drawn by small programs over the lessons' own headers, anew whenever an option changes.
(() => {
    const { made, script } = Page;
    let loading;
    const figures = () => (loading ??= script('drawings.js').then(async () => WebAssembly.compile(await Page.unpacked(RAYSTEPS.drawings.wasm))));

    async function enliven(figure) {
        const module = await figures(), { figure: name } = figure.dataset, chosen = new Map(), image = figure.querySelector('img');
        const words = made('p', { className: 'words' }), stage = made('div');
        const draw = () => {
            const program = new Raysteps.Program(module);
            program.drawn = (svg, text) => {
                stage.innerHTML = `<svg viewBox="0 0 760 380" role="img">${svg}</svg>`;
                stage.firstChild.setAttribute('aria-label', image.alt);
                words.textContent = text.trim();
            };
            return program.start([name, ...[...chosen.values()].flat()]);
        };
        const { options } = draw();
        const controls = options.filter(({ kind }) => kind !== 'image').map((option) => Page.control(option, (given) => {
            chosen.set(option.name, given);
            try { draw(); } catch (problem) { words.textContent = problem.message; }
        }));
        words.setAttribute('role', 'status');
        image.hidden = true;
        figure.append(stage, made('div', { className: 'controls' }, ...controls.map(({ label }) => label)), words);
        figure.dataset.drawn = name;
    }

    const sight = new IntersectionObserver((entries) => {
        for (const { isIntersecting, target } of entries)
            if (isIntersecting) {
                sight.unobserve(target);
                enliven(target).catch((problem) => { target.dataset.problem = problem.message; });
            }
    }, { rootMargin: '200px' });
    for (const figure of Page.all('figure.explain')) sight.observe(figure);
})();
