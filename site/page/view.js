// A canvas that shows what a command line renders: a first sample of every pixel at once, the others one after the other.
(() => {
    const { script } = Page;
    const bytes_of = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const unpacked = async (base64) =>
        new Uint8Array(await new Response(new Blob([bytes_of(base64)]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());

    async function asset(name) {
        await script(`asset_${name}.js`);
        return unpacked(RAYSTEPS.assets[name]);
    }

    const steps = {};
    /** A step's program: {bytes, module, files}. */
    const step = (name) => (steps[name] ??= (async () => {
        await script(`step_${name}.js`);
        const { wasm, files } = RAYSTEPS.steps[name];
        const bytes = await unpacked(wasm);
        const contents = await Promise.all(files.map(async (file) => [file, await asset(file)]));
        return { bytes, module: await WebAssembly.compile(bytes), files: Object.fromEntries(contents) };
    })());

    const mistakes = {};
    /** The mistakes of a step: {list, code(mistake)}, where code answers its program. */
    const mistakes_of = (name) => (mistakes[name] ??= (async () => {
        await script(`mistakes_${name}.js`);
        const { list, patches } = RAYSTEPS.mistakes[name];
        const all = await unpacked(patches), right = await step(name);
        const code = async ({ at, size }) => ({ ...right, module: await WebAssembly.compile(Raysteps.patched(right.bytes, all.subarray(at, at + size))) });
        return { list, code };
    })());

    const traces = {};
    /** The program that tells the rays of a step's picture. */
    const trace_of = (name) => (traces[name] ??= (async () => {
        await script(`trace_${name}.js`);
        const right = await step(name), patch = await unpacked(RAYSTEPS.traces[name]);
        return { ...right, module: await WebAssembly.compile(Raysteps.patched(right.bytes, patch)) };
    })());

    let worker_address;
    function started_worker(code) {
        worker_address ??= URL.createObjectURL(new Blob([`globalThis.Raysteps = (${makeRaysteps})(); (${rayStepsWorker})();`], { type: 'text/javascript' }));
        const worker = new Worker(worker_address);
        worker.postMessage({ module: code.module, files: code.files });
        return worker;
    }

    class View {
        /** `tell` is called with {problem}, with {first} (the milliseconds of the first pass) and with {done} samples. */
        constructor(canvas, code, tell, most_workers = 8) {
            Object.assign(this, { canvas, tell, number: 0, wish: null, busy: false, scale: 1 });
            this.context = canvas.getContext('2d', { alpha: false });
            this.workers = Array.from({ length: Math.max(1, Math.min(navigator.hardwareConcurrency ?? 2, most_workers)) }, () => started_worker(code));
            for (const worker of this.workers) worker.onmessage = ({ data }) => this.take(data);
        }

        use(code) {
            for (const worker of this.workers) worker.postMessage({ module: code.module, files: code.files });
        }

        /** Shows a job {words, width, height, samples}. A job that waits is replaced, so that every picture shown is whole. */
        show(job) {
            this.wish = this.job = job;
            if (!this.busy) this.begin();
        }

        /** Stops until resume(). */
        pause() {
            this.wish = null;
            this.busy = false;
            ++this.number;
            for (const worker of this.workers) worker.postMessage({ number: this.number });
        }

        resume() { if (this.job && !this.finished) this.show(this.job); }

        begin() {
            const job = this.wish;
            this.wish = null;
            if (!job) return;
            Object.assign(this, { shown: job, busy: true, finished: false, waiting: this.workers.length, ended: 0, tiles: [], asked: performance.now() });
            ++this.number;
            this.workers.forEach((worker, share) => worker.postMessage({ ...job, number: this.number, share, shares: this.workers.length }));
        }

        take({ number, tiles = [], done, rays, problem }) {
            if (number !== this.number) return;
            if (problem !== undefined) {
                this.busy = false;
                this.finished = true;
                this.tell({ problem });
                return this.begin();
            }
            if (this.waiting) this.tiles.push(...tiles); else this.draw(tiles);
            if (done === 1 && --this.waiting === 0) this.first_pass();
            else if (done > 1 && !this.waiting) this.tell({ done, rays });
            if (done === this.shown.samples && ++this.ended === this.workers.length) {
                this.finished = true;
                this.tell({ done, whole: true });
            }
        }

        first_pass() {
            const { width, height } = this.shown;
            if (this.canvas.width !== width) Object.assign(this.canvas, { width, height });
            this.draw(this.tiles);
            this.tiles = [];
            this.busy = false;
            this.tell({ done: 1, first: performance.now() - this.asked });
            this.begin();
        }

        draw(tiles) {
            for (const { x, y, width, rgba } of tiles) this.context.putImageData(new ImageData(rgba, width), x, y);
        }
    }

    Object.assign(Page, { unpacked, step, mistakes_of, trace_of, View });
})();
