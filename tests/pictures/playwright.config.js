import page from '../page/playwright.config.js';

export default { ...page, testDir: '.', timeout: 60_000 };
