// Runs a step's program: in a page, in a worker, in node. Not a module, so that pages opened as files can load it.
globalThis.makeRaysteps = () => {
    const decoder = new TextDecoder(), encoder = new TextEncoder();

    /** Thrown through the program's frames, to leave main() without returning from it. */
    class Left {
        constructor(failure) { this.failure = failure; }
    }

    class Program {
        /** `files` maps names to bytes; `print` is called with what the program prints. */
        constructor(module, files = {}, print = () => {}) {
            const needed = { page: this.#page(), wasi_snapshot_preview1: this.#system(print) };
            this.exports = new WebAssembly.Instance(module, needed).exports;
            this.memory = this.exports.memory;
            this.exports._initialize?.();
            this.stack = this.exports.__stack_pointer.value;
            for (const [name, bytes] of Object.entries(files)) this.#hand_over(name, bytes);
        }

        #page() {
            return {
                declare: (at, size) => { this.declared = JSON.parse(this.#text(at, size)); },
                ready: () => { throw new Left(); },
                fail: (at, size) => { throw new Left(this.#text(at, size)); },
                drawn: (svg, size, words, length) => this.drawn?.(this.#text(svg, size), this.#text(words, length)), // of a figure
                ray: (...numbers) => this.ray?.(...numbers), // of a program that tells its rays
            };
        }

        /** The few calls of the system that the C library makes; all others answer "no such file". */
        #system(print) {
            const view = () => new DataView(this.memory.buffer);
            const known = {
                fd_write: (file, parts, count, written) => {
                    let total = 0;
                    for (let part = parts; part < parts + 8 * count; part += 8) {
                        const size = view().getUint32(part + 4, true);
                        print(this.#text(view().getUint32(part, true), size));
                        total += size;
                    }
                    view().setUint32(written, total, true);
                    return 0;
                },
                environ_sizes_get: (count, size) => {
                    view().setUint32(count, 0, true);
                    view().setUint32(size, 0, true);
                    return 0;
                },
                environ_get: () => 0,
                fd_fdstat_get: (file, at) => { // a terminal, to which whole lines are written
                    new Uint8Array(this.memory.buffer, at, 24).fill(0);
                    view().setUint8(at, 2);
                    return 0;
                },
                proc_exit: (code) => { throw new Left(`the program ended with ${code}`); },
            };
            const nothing = () => 8;
            return new Proxy(known, { get: (calls, name) => calls[name] ?? nothing });
        }

        #text(at, size) {
            return decoder.decode(new Uint8Array(this.memory.buffer, at, size));
        }

        #copied(bytes) {
            const at = this.exports.allocate(bytes.length);
            new Uint8Array(this.memory.buffer, at, bytes.length).set(bytes);
            return at;
        }

        #hand_over(name, bytes) {
            const at = this.exports.make_file(this.#copied(encoder.encode(name + '\0')), bytes.length);
            new Uint8Array(this.memory.buffer, at, bytes.length).set(bytes);
        }

        /** Runs main() with words as in a terminal, until it wants to render. Throws what the program says. */
        start(words) {
            this.exports.__stack_pointer.value = this.stack;
            const all = ['program', ...words];
            const at = this.#copied(encoder.encode(all.map((word) => word + '\0').join('')));
            try {
                this.exports.start(at, all.length);
            } catch (left) {
                if (!(left instanceof Left)) throw left;
                if (left.failure) throw new Error(left.failure);
            }
            return this.declared;
        }

        /** Adds samples begin to end - 1 to a tile and answers its colours so far, four bytes a pixel. */
        add_samples(x0, y0, x1, y1, begin, end) {
            const size = 4 * (x1 - x0) * (y1 - y0);
            if (!(this.tile?.size >= size)) this.tile = { at: this.exports.allocate(size), size };
            this.exports.add_samples(x0, y0, x1, y1, begin, end, this.tile.at);
            return new Uint8ClampedArray(this.memory.buffer.slice(this.tile.at, this.tile.at + size));
        }

        rays() { return this.exports.rays(); }
    }

    /**
     * The bytes of a program with a mistake, from those of the right one. A patch is a list of: where to copy from,
     * how much, how many new bytes follow (32 bits each), and these.
     */
    function patched(right, patch) {
        const view = new DataView(patch.buffer, patch.byteOffset, patch.length);
        const parts = [];
        for (let at = 0; at < patch.length;) {
            const [from, size, fresh] = [0, 4, 8].map((field) => view.getUint32(at + field, true));
            parts.push(right.subarray(from, from + size), patch.subarray(at + 12, at + 12 + fresh));
            at += 12 + fresh;
        }
        const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
        parts.reduce((at, part) => (whole.set(part, at), at + part.length), 0);
        return whole;
    }

    return { Program, patched };
};
globalThis.Raysteps = makeRaysteps();
