// Click a pixel: the rays of its first sample, drawn into a view from the side, and told as ./learn trace tells them.
(() => {
    const { made, View } = Page;
    const minus = (a, b) => a.map((x, i) => x - b[i]);
    const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
    const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
    const unit = (a) => { const length = Math.hypot(...a); return a.map((x) => x / length); };
    const kinds = ['sky', 'surface', 'shadow', 'light'];
    const nearest = 0.05; // metres: what is closer to the eye, or behind it, is cut off

    /** Where a camera sees the ends of a line, in pixels, or null if the line is behind it. */
    function seen({ from, at, fov }, { width, height }, ends) {
        const forward = unit(minus(at, from)), right = unit(cross(forward, [0, 1, 0])), up = cross(right, forward);
        const [a, b] = ends.map((point) => minus(point, from)), ahead = [dot(a, forward), dot(b, forward)];
        if (Math.max(...ahead) < nearest) return null;
        const cut = (p, q, zp, zq) => (zp >= nearest ? p : p.map((x, i) => x + (q[i] - x) * (nearest - zp) / (zq - zp)));
        const half = Math.tan(fov * Math.PI / 360);
        const pixel = (p) => {
            const z = dot(p, forward) * half;
            return [(1 + dot(p, right) / z * height / width) * width / 2, (1 - dot(p, up) / z) * height / 2];
        };
        return [pixel(cut(a, b, ahead[0], ahead[1])), pixel(cut(b, a, ahead[1], ahead[0]))];
    }

    const place = ({ from, at, fov }) => ['--from', from.join(','), '--at', at.join(','), '--fov', String(fov)];

    const programs = new Map(), largest_memory = 3e8; // every start leaves its scene behind
    async function program_of(step) {
        const known = programs.get(step);
        if (known && known.memory.buffer.byteLength < largest_memory) return known;
        const code = await Page.trace_of(step);
        programs.set(step, new Raysteps.Program(code.module, code.files, (more) => programs.get(step).print(more)));
        return programs.get(step);
    }

    /** {text, rays: [{from, to, kind, depth, line}]} of a pixel, by the program of ./learn trace. */
    async function traced(live, words, x, y) {
        const program = await program_of(live.step), rays = [];
        let text = '';
        program.print = (more) => { text += more; };
        program.ray = (...numbers) => rays.push({ from: numbers.slice(0, 3), to: numbers.slice(3, 6), kind: kinds[numbers[6]],
            depth: numbers[7], line: text.split('\n').length - 1 });
        try {
            program.start([...words, '--crop', `${x},${y},${x + 1},${y + 1}`]);
            program.exports.tell_next_sample();
            program.add_samples(x, y, x + 1, y + 1, 0, 1);
        } catch (problem) {
            programs.delete(live.step);
            throw problem;
        }
        return { text: text.trimEnd(), rays };
    }

    /** A camera beside the first ray that sees what this ray meets: nothing stands between. */
    async function beside(live, words, first) {
        const at = (first?.kind === 'surface' ? first.to : live.camera.at).map((x) => Number(x.toFixed(3)));
        const all = [[1.1, 0.95], [-1.1, 0.95], [0.7, 0.95], [-0.7, 0.95], [0.7, 0.5], [-0.7, 0.5], [0.35, 0.8], [-0.35, 0.8]].map(([across, far]) =>
            ({ ...Page.walked({ from: live.camera.from, at }, { across, upward: 0.15, far }), fov: far < 0.9 ? 60 : 40 }));
        for (const camera of all) {
            const { rays: [{ to }] } = await traced(live, [...words, ...place(camera)], live.size.width >> 1, live.size.height >> 1);
            if (Math.hypot(...minus(to, at)) < 0.1 * Math.hypot(...minus(camera.from, at))) return camera;
        }
        return all[0];
    }

    const svg = (tag, attributes) => {
        const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
        for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
        return element;
    };

    /** The panel below a live picture that shows the rays of the pixel chosen last. */
    class Rays {
        constructor(live) {
            this.live = live;
            const { width, height } = live.size;
            this.canvas = made('canvas', { width, height });
            this.canvas.setAttribute('role', 'img');
            this.canvas.setAttribute('aria-label', 'The scene from the side, with the rays of the chosen pixel; the list tells them in words.');
            this.lines = svg('svg', { viewBox: `0 0 ${width} ${height}`, 'aria-hidden': 'true' });
            this.list = made('pre', { tabIndex: 0 });
            this.list.setAttribute('aria-label', 'The rays of the chosen pixel');
            this.title = made('p', { className: 'state' });
            this.title.setAttribute('role', 'status');
            this.panel = made('div', { className: 'rays' }, made('div', { className: 'side' }, this.canvas, this.lines), this.title, this.list);
        }

        async choose(x, y) {
            this.pixel = [x, y];
            const { live } = this, { text, rays } = await traced(live, live.sized_words(), x, y);
            if (!this.panel.isConnected) {
                live.command.before(this.panel);
                this.view = new View(this.canvas, live.code, () => {}, 1);
            }
            const words = live.sized_words({ moved: false });
            this.side = await beside(live, words, rays[0]);
            this.view.show({ words: [...words, ...place(this.side)], ...live.size, samples: 2 });
            this.title.textContent = `Pixel ${x},${y}, its first sample: ${rays.length} ${rays.length === 1 ? 'ray' : 'rays'}. From the side:`;
            this.draw(rays);
            this.tell(text, rays);
            live.figure.dataset.rays = rays.length;
        }

        draw(rays) {
            this.drawn = rays.map((ray) => {
                const ends = seen(this.side, this.live.size, [ray.from, ray.to]);
                if (!ends) return null;
                const [[x1, y1], [x2, y2]] = ends;
                return svg('line', { x1, y1, x2, y2, class: ray.kind, style: `opacity: ${Math.max(0.35, 1 - 0.12 * ray.depth)}` });
            });
            const eye = seen(this.side, this.live.size, [this.live.camera.from, this.live.camera.from]);
            const dot = eye ? [svg('circle', { cx: eye[0][0], cy: eye[0][1], r: 5 })] : [];
            this.lines.replaceChildren(...this.drawn.filter(Boolean), ...dot);
        }

        /** The text, of which each line about a ray lights that ray up. */
        tell(text, rays) {
            const by_line = new Map(rays.map((ray, i) => [ray.line, i]));
            this.list.replaceChildren(...text.split('\n').map((words, number) => {
                const line = made('span', { textContent: `${words.replace(/^ {2}/, '')}\n` }), ray = this.drawn[by_line.get(number)];
                if (!ray) return line;
                const light = (on) => { ray.classList.toggle('lit', on); line.classList.toggle('lit', on); };
                line.tabIndex = 0;
                line.className = 'ray';
                line.onmouseenter = line.onfocus = () => light(true);
                line.onmouseleave = line.onblur = () => light(false);
                return line;
            }));
        }
    }
    Object.assign(Page, { Rays });
})();
