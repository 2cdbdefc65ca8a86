// A server of plain files: node server.js PORT FOLDER [cors]
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const [port, folder, cors] = process.argv.slice(2);
const types = {
  '.css': 'text/css',
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

createServer(async (request, response) => {
  const { pathname } = new URL(request.url, 'http://localhost');
  const path = join(folder, normalize(decodeURIComponent(pathname)));
  if (!(await stat(path).catch(() => null))?.isFile()) {
    // The first says that the server is there; the second is asked for by browsers alone.
    response.writeHead(['/', '/favicon.ico'].includes(pathname) ? 204 : 404).end();
    return;
  }
  if (cors) response.setHeader('Access-Control-Allow-Origin', '*');
  response.setHeader('Content-Type', types[extname(path)] ?? 'application/octet-stream');
  createReadStream(path).pipe(response);
}).listen(Number(port), '127.0.0.1');
