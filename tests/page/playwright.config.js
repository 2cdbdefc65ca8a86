import { defineConfig } from '@playwright/test';

const top = new URL('../..', import.meta.url).pathname;

export default defineConfig({
  testDir: '.',
  outputDir: `${top}/test-results`,
  // There is one serial port.
  workers: 1,
  forbidOnly: true,
  timeout: 30_000,
  expect: { timeout: 8_000 },
  reporter: [['list']],
  use: {
    baseURL: 'http://localhost:8089',
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
      args: [
        '--no-sandbox',
        '--disable-gpu',
        '--disable-quic',
        '--disable-dev-shm-usage',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
        '--host-resolver-rules=MAP encoderscope.test 127.0.0.1',
      ],
    },
  },
  webServer: {
    command: 'npx vite preview --port 8089 --logLevel warn',
    cwd: top,
    url: 'http://localhost:8089',
    reuseExistingServer: false,
  },
});
