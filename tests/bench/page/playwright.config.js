import page from '../../page/playwright.config.js';

// Measurements of the page: minutes long, one after the other, never repeated unasked.
export default { ...page, testDir: '.', timeout: 600_000, outputDir: page.outputDir };
