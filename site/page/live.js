// Live pictures: a chapter's own program in the page. Without it the still picture stays.
(() => {
    const { made, script, View } = Page;
    const shown_width = 480, slow = 90; // pixels; milliseconds of a pass while dragging
    const coarse = 3; // the very first pass has so many times fewer columns and rows
    const number = (value) => Number(value.toPrecision(3));

    /** The controls of one option of the program; `change` is called with the words for the command line, or none. */
    function control({ name, kind, low, high, initial, names, help }, change) {
        const label = made('label', { title: help }, made('span', { textContent: name.replaceAll('-', ' ') }));
        const about = made('small', { textContent: help });
        if (kind === 'flag') {
            const input = made('input', { type: 'checkbox', onchange: () => change(input.checked ? [`--${name}`] : []) });
            label.className = 'flag';
            label.prepend(input);
            label.append(about);
            return { label, reset: () => { input.checked = false; } };
        }
        if (kind === 'choice') {
            const select = made('select', { onchange: () => change(select.value === initial ? [] : [`--${name}`, select.value]) },
                ...names.map((each) => made('option', { textContent: each, selected: each === initial })));
            label.append(select, about);
            return { label, reset: () => { select.value = initial; } };
        }
        // A wide range is shown up to a few times the default: the terminal has the rest.
        const top = low >= 0 && high > 8 * Math.max(1, initial) ? 4 * Math.max(1, initial) : high;
        const input = made('input', { type: 'range', min: low, max: top, step: kind === 'whole' ? 1 : 'any', value: initial });
        const output = made('output', { textContent: initial });
        input.oninput = () => {
            const value = number(input.valueAsNumber);
            output.textContent = value;
            change(value === initial ? [] : [`--${name}`, String(value)]);
        };
        label.append(output, input, about);
        return { label, reset: () => { input.value = initial; output.textContent = initial; } };
    }

    /** A picture that can be walked round. Its state is its command line. */
    class Live {
        constructor(figure, code, declared, { step, options = [], words = [] }) {
            Object.assign(this, { figure, code, step, fixed: words, chosen: new Map() });
            const option = (name) => declared.options.find((each) => each.name === name);
            const given = (name) => { const at = words.indexOf(name); return at < 0 ? undefined : words[at + 1]; };
            const [width, height] = ['width', 'height'].map((name) => option(name).initial);
            this.size = { width: Math.min(shown_width, width), height: Math.round(height * Math.min(1, shown_width / width)) };
            if (width === height) this.size = { width: 360, height: 360 };
            this.samples = Number(given('--samples') ?? option('samples').initial);
            this.home = { from: option('from').initial, at: option('at').initial, fov: option('fov').initial };
            this.camera = this.home;
            if ('trace' in figure.dataset) this.rays = new Page.Rays(this);
            this.make_stage(figure.querySelector('img'));
            this.make_controls(options.map(option).filter(Boolean));
            this.view = new View(this.canvas, code, (news) => this.tell(news));
            this.listen();
        }

        make_stage(image) {
            this.image = image;
            this.canvas = made('canvas', { ...this.size, tabIndex: 0 });
            this.canvas.setAttribute('role', 'img');
            this.canvas.setAttribute('aria-label', `${image?.alt ?? 'A picture with a mistake'}. The arrow keys walk around it, plus and minus go closer and away.${this.rays ? ' Enter tells the rays of the middle pixel.' : ''}`);
            this.stage = made('div', { className: 'stage' }, this.canvas, made('p', { className: 'hint', textContent: this.rays ? 'drag to walk around · click a pixel for its rays' : 'drag to walk around' }));
        }

        make_controls(options) {
            this.controls = options.map((option) => control(option, (words) => {
                this.chosen.set(option.name, words);
                this.draw();
            }));
            this.panel = made('div', { className: 'controls' }, ...this.controls.map(({ label }) => label));
            this.line = made('code', { tabIndex: 0 });
            const copy = made('button', { type: 'button', className: 'small', textContent: 'Copy' });
            copy.onclick = async () => {
                await navigator.clipboard?.writeText(this.line.textContent);
                copy.textContent = 'Copied';
                setTimeout(() => { copy.textContent = 'Copy'; }, 1500);
            };
            const reset = made('button', { type: 'button', className: 'small', textContent: 'Reset', onclick: () => this.reset() });
            this.command = made('div', { className: 'command' }, this.line, copy, reset);
            this.state = made('p', { className: 'state', role: 'status' });
            this.figure.append(...(options.length ? [this.panel] : []), this.command, this.state);
        }

        /** The words of the command line but for the size; without the camera's if `moved` is false. */
        words({ moved = true } = {}) {
            const from = !moved || this.camera === this.home ? [] : ['--from', this.camera.from.join(',')];
            return [...this.fixed, ...[...this.chosen.values()].flat(), ...from];
        }

        /** The same with the size. */
        sized_words({ scale = 1, moved = true } = {}) {
            const size = ['width', 'height'].flatMap((name) => [`--${name}`, String(Math.round(this.size[name] / scale))]);
            return [...size, '--samples', String(this.samples), ...this.words({ moved })];
        }

        /** The field of view, which an option may have changed. */
        get fov() { return Number(this.chosen.get('fov')?.[1] ?? this.home.fov); }

        draw(scale = 1) {
            const [width, height] = [this.size.width, this.size.height].map((side) => Math.round(side / scale));
            this.line.textContent = `./learn run ${this.step.slice(0, 2)} ${this.sized_words().join(' ')}`;
            this.view.show({ words: this.sized_words({ scale }), width, height, samples: scale === 1 ? this.samples : 1 });
            if (scale === 1 && this.rays?.pixel) this.rays.choose(...this.rays.pixel);
        }

        /** Shows the rays of the pixel under the pointer. */
        choose({ clientX, clientY }) {
            const box = this.canvas.getBoundingClientRect();
            const [x, y] = [(clientX - box.left) / box.width * this.size.width, (clientY - box.top) / box.height * this.size.height];
            this.rays?.choose(Math.floor(x), Math.floor(y)).catch((problem) => this.tell({ problem: problem.message }));
        }

        reset() {
            this.camera = this.home;
            this.chosen.clear();
            if (this.rays) this.rays.pixel = null;
            this.rays?.panel.remove();
            for (const each of this.controls) each.reset();
            this.draw();
        }

        tell({ problem, first, done, whole }) {
            this.state.classList.toggle('problem', problem !== undefined);
            if (problem !== undefined) {
                this.figure.dataset.problem = problem;
                this.state.textContent = problem;
                return;
            }
            delete this.figure.dataset.problem;
            if (first !== undefined) this.show_first(first);
            this.figure.dataset.done = done;
            if (whole && this.view.shown.width === this.size.width) this.figure.dataset.whole = this.line.textContent;
            this.state.textContent = `${done} of ${this.samples} samples a pixel · first pass ${Math.round(this.first)} ms · ${this.view.workers.length} ${this.view.workers.length > 1 ? 'cores' : 'core'}`;
        }

        show_first(milliseconds) {
            this.first = milliseconds;
            this.figure.dataset.first = milliseconds.toFixed(0);
            if (!this.stage.isConnected) {
                if (this.image) this.image.replaceWith(this.stage); else this.figure.prepend(this.stage);
                this.draw();
            }
        }

        walk(move, scale = 1) {
            this.camera = Page.walked(this.camera, move);
            this.stage.classList.add('touched');
            this.draw(scale);
        }

        /** While the pointer is down, a slow picture is drawn smaller. */
        get drag_scale() { return this.first > 2 * slow ? 3 : this.first > slow ? 2 : 1; }

        listen() {
            const { canvas } = this;
            let held = null, pressed = null, scale = 1;
            const still = (event) => Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) < 4;
            canvas.onpointerdown = (event) => {
                held = pressed = event;
                scale = this.drag_scale;
                canvas.setPointerCapture(event.pointerId);
            };
            canvas.onpointermove = (event) => {
                if (!held || (held === pressed && still(event))) return;
                this.walk({ across: -(event.clientX - held.clientX) * 0.008, upward: (event.clientY - held.clientY) * 0.006 }, scale);
                held = event;
            };
            canvas.onpointerup = canvas.onpointercancel = (event) => {
                if (held && held === pressed && event.type === 'pointerup') this.choose(event);
                else if (held && (scale > 1 || this.rays?.pixel)) this.draw();
                held = null;
            };
            canvas.addEventListener('wheel', (event) => {
                if (document.activeElement !== canvas) return; // the page scrolls until the picture is clicked
                event.preventDefault();
                this.walk({ far: Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.002) });
            }, { passive: false });
            const keys = { ArrowLeft: { across: -0.08 }, ArrowRight: { across: 0.08 }, ArrowUp: { upward: 0.08 }, ArrowDown: { upward: -0.08 }, '+': { far: 0.9 }, '=': { far: 0.9 }, '-': { far: 1 / 0.9 } };
            canvas.onkeydown = (event) => {
                if (event.key === 'Enter') this.rays?.choose(this.size.width >> 1, this.size.height >> 1);
                if (!keys[event.key]) return;
                event.preventDefault();
                this.walk(keys[event.key]);
            };
        }
    }

    const sight = new IntersectionObserver((entries) => {
        for (const { isIntersecting, target } of entries) target.sees?.(isIntersecting);
    }, { rootMargin: '120px' });

    /** Makes a figure live while it is in view. */
    async function enliven(figure, more = {}) {
        const { step, options, words } = figure.dataset;
        const code = await Page.step(step);
        const fixed = words?.split(' ').filter(Boolean) ?? [];
        const declared = new Raysteps.Program(code.module, code.files).start(fixed);
        const live = new Live(figure, more.code ?? code, declared, { step, options: options?.split(',').filter(Boolean), words: fixed });
        live.draw(coarse);
        figure.sees = (seen) => (seen ? live.view.resume() : live.view.pause());
        sight.observe(figure);
        return live;
    }

    function fail(figure, problem) {
        figure.dataset.problem = problem.message;
        figure.append(made('p', { className: 'state problem', role: 'status', textContent: `This picture stays still: ${problem.message}` }));
    }

    const able = () => {
        if (!globalThis.WebAssembly) throw new Error('this browser has no WebAssembly');
        if (!globalThis.DecompressionStream) throw new Error('this browser is too old to unpack its program');
    };
    const begin = async (figure) => {
        try {
            able();
            await enliven(figure);
        } catch (problem) {
            fail(figure, problem.name === 'CompileError' ? new Error('this browser has no WebAssembly with SIMD') : problem);
        }
    };

    for (const figure of Page.all('figure.live')) {
        if (figure.dataset.step >= '05') { // a model of a megabyte is loaded only if asked for
            const button = made('button', { type: 'button', className: 'begin', textContent: 'Bring this picture to life (1 MB)' });
            button.onclick = () => { button.remove(); begin(figure); };
            figure.append(button);
        } else {
            figure.sees = (seen) => { if (seen) { figure.sees = null; begin(figure); } };
            sight.observe(figure);
        }
    }
    Object.assign(Page, { enliven, control });
})();
