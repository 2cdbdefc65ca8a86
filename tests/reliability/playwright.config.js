import page from '../page/playwright.config.js';

// Faults, one after the other; some take minutes.
export default { ...page, testDir: '.', timeout: 120_000, outputDir: page.outputDir };
