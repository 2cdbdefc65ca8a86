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
  '.wasm': 'application/wasm',
};

createServer(async (request, response) => {
  const { pathname } = new URL(request.url, 'http://localhost');
  const path = join(folder, normalize(decodeURIComponent(pathname)));
  const type = types[extname(path)];
  if (!type || !(await stat(path).catch(() => null))?.isFile()) {
    response.writeHead(pathname === '/' ? 200 : 404).end();
    return;
  }
  if (cors) response.setHeader('Access-Control-Allow-Origin', '*');
  response.setHeader('Content-Type', type);
  createReadStream(path).pipe(response);
}).listen(Number(port), '127.0.0.1');
