// A page that nobody looks at, or whose machine sleeps.

/** Puts the worker to sleep, as a machine does whose lid is closed. */
export const sleep = (page, milliseconds) =>
  page.workers()[0].evaluate((milliseconds) => {
    const end = performance.now() + milliseconds;
    while (performance.now() < end);
  }, milliseconds);

/** Lets the worker's clock jump, as one does that went on while the machine slept. */
export const jump = (page, milliseconds) =>
  page.workers()[0].evaluate((milliseconds) => {
    const now = performance.now.bind(performance);
    performance.now = () => now() + milliseconds;
  }, milliseconds);

/** Freezes a page, as a browser does with tabs in the background. */
export const freeze = async (page, milliseconds) => {
  const session = await page.context().newCDPSession(page);
  await session.send('Page.setWebLifecycleState', { state: 'frozen' });
  await new Promise((done) => setTimeout(done, milliseconds));
  await session.send('Page.setWebLifecycleState', { state: 'active' });
};

/** Lets a page be hidden later on. */
export const hideable = (page) =>
  page.addInitScript(() => {
    window.hidden = false;
    const draw = window.requestAnimationFrame.bind(window);
    window.held = [];
    window.requestAnimationFrame = (then) => (window.hidden ? window.held.push(then) : draw(then));
  });

/** A page that nobody sees draws nothing. */
export const hide = (page) =>
  page.evaluate(() => {
    window.hidden = true;
  });

/** It is seen again. */
export const unhide = (page) =>
  page.evaluate(() => {
    window.hidden = false;
    for (const then of window.held.splice(0)) requestAnimationFrame(then);
  });
