import { defineConfig } from '@playwright/test';
import page from '../page/playwright.config.js';

const top = new URL('../..', import.meta.url).pathname;
const serve = (port, folder, cors = '') => ({
  command: `node server.js ${port} ${folder} ${cors}`,
  url: `http://localhost:${port}`,
  reuseExistingServer: false,
});

export default defineConfig({
  ...page,
  testMatch: '*.spec.js',
  outputDir: `${top}/test-results`,
  use: { ...page.use, baseURL: 'http://localhost:8091' },
  webServer: [
    // A project that has installed the package; its pages, from another origin; the documents.
    serve(8091, process.env.PROJECT, 'cors'),
    serve(8092, process.env.PROJECT),
    serve(8093, `${top}/target/docs`),
  ],
});
