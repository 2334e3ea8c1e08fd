// A worker's loop: renders its share of the tiles of the newest picture asked for, sample after sample.
globalThis.rayStepsWorker = () => {
    const tile_side = 16, largest_memory = 3e8, frame = 16;
    let module, files, program, newest = 0;
    const channel = new MessageChannel();
    /** Lets messages in. */
    const pause = () => new Promise((go) => { channel.port1.onmessage = go; channel.port2.postMessage(0); });

    onmessage = ({ data }) => {
        if (data.module) {
            ({ module, files } = data);
            program = null;
        } else {
            newest = data.number;
            if (data.words) render(data);
        }
    };

    function started(words) {
        if (program?.memory.buffer.byteLength > largest_memory) program = null; // every start leaves its scene behind
        program ??= new Raysteps.Program(module, files);
        program.start(words);
    }

    async function render(job) {
        try {
            started(job.words);
            await passes(job);
        } catch (problem) {
            program = null;
            postMessage({ number: job.number, problem: plain(problem) });
        }
    }

    const plain = (problem) => (problem instanceof RangeError || problem instanceof WebAssembly.RuntimeError
        ? 'the program ran out of memory: make the picture smaller' : problem.message);

    async function passes({ number, width, height, samples, share, shares }) {
        let tiles = [], posted = performance.now();
        const post = (more) => {
            postMessage({ number, tiles, ...more }, tiles.map((tile) => tile.rgba.buffer));
            tiles = [];
            posted = performance.now();
        };
        const columns = Math.ceil(width / tile_side), count = columns * Math.ceil(height / tile_side);
        for (let sample = 0; sample < samples; ++sample) {
            for (let i = share; i < count; i += shares) {
                const x = (i % columns) * tile_side, y = Math.floor(i / columns) * tile_side;
                const x1 = Math.min(width, x + tile_side), y1 = Math.min(height, y + tile_side);
                tiles.push({ x, y, width: x1 - x, rgba: program.add_samples(x, y, x1, y1, sample, sample + 1) });
                if (performance.now() - posted < frame) continue;
                if (sample > 0) post();
                await pause();
                if (newest !== number) return;
                posted = performance.now();
            }
            post({ done: sample + 1, rays: program.rays() });
            await pause();
            if (newest !== number) return;
        }
    }
};
