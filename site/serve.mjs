// Serves a folder to the browsers of this machine: node site/serve.mjs FOLDER [PORT]
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize, resolve, sep } from 'node:path';

const folder = resolve(process.argv[2]);
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css', '.svg': 'image/svg+xml',
    '.png': 'image/png', '.woff2': 'font/woff2', '.pdf': 'application/pdf' };

const server = createServer(async (request, response) => {
    try {
        const path = normalize(join(folder, decodeURIComponent(new URL(request.url, 'http://localhost').pathname)));
        if (path !== folder && !path.startsWith(folder + sep)) throw new Error('outside');
        const file = extname(path) ? path : join(path, 'index.html');
        const bytes = await readFile(file);
        response.setHeader('content-type', types[extname(file)] ?? 'application/octet-stream').end(bytes);
    } catch {
        response.writeHead(404, { 'content-type': 'text/plain' }).end('there is no such page\n');
    }
});
server.listen(Number(process.argv[3] ?? 8000), '127.0.0.1', () => console.log(`http://127.0.0.1:${server.address().port}/ (Ctrl-C ends)`));
server.on('error', (problem) => {
    console.error(`serve.mjs: ${problem.code === 'EADDRINUSE' ? 'port 8000 is in use: node site/serve.mjs FOLDER PORT takes another' : problem.message}`);
    process.exit(2);
});
