// Keeps the page for visits without the network. A new version waits until the user wants it, and
// for the end of every recording, on this page or another one of the same site.

import { t } from './language.js';

// Who records holds this lock with others; who takes a new version into use needs it alone.
const LOCK = 'recording';
const { locks, serviceWorker } = navigator;

let ended = () => {};
// Looks whether the new version can be used, once there is one.
let look = () => {};

/** Whether a recording runs on this page. */
export const recording = (runs) => {
  ended();
  if (!runs) return;
  const end = new Promise((resolve) => (ended = resolve));
  locks?.request(LOCK, { mode: 'shared' }, () => end);
  look();
};

/** Says that a new version is there. */
const show = (registration) => {
  const button = document.createElement('button');
  button.dataset.testid = 'update-now';
  const why = document.createElement('span');
  const box = Object.assign(document.createElement('p'), { className: 'update', role: 'status' });
  box.dataset.testid = 'update';

  /** Says it at the end of the header, which is made anew with the language. */
  const say = () => {
    button.textContent = t('Use it now');
    why.textContent = button.disabled ? t('Not while a recording runs.') : '';
    box.replaceChildren(t('A new version is ready. '), button, why);
    document.querySelector('header').append(box);
  };
  say();
  const spoken = new MutationObserver(() => requestAnimationFrame(say));
  spoken.observe(document.documentElement, { attributeFilter: ['lang'] });

  const allow = (allowed) => {
    button.disabled = !allowed;
    say();
  };

  /** Does something where nothing is recorded; else the button is off until that has ended. */
  const alone = (then) =>
    locks.request(LOCK, { ifAvailable: true }, (lock) => {
      if (lock) return then();
      allow(false);
      locks.request(LOCK, () => allow(true));
    });

  /** Holds the lock until the page is loaded anew. */
  const use = () =>
    new Promise(() => {
      const { waiting } = registration;
      // Another page of the site may have taken it into use.
      if (!waiting) return location.reload();
      waiting.addEventListener('statechange', () => waiting.state === 'activated' && location.reload());
      waiting.postMessage({ type: 'SKIP_WAITING' });
    });

  button.addEventListener('click', () => alone(use));
  look = () => alone(() => allow(true));
  look();
};

const register = async () => {
  const registration = await serviceWorker.register('./sw.js');
  let shown = false;
  const check = () => {
    // The first version of all waits for nobody.
    if (shown || !registration.active || !registration.waiting) return;
    shown = true;
    show(registration);
  };
  const watch = () => registration.installing?.addEventListener('statechange', check);
  registration.addEventListener('updatefound', watch);
  watch();
  check();
  // Browsers look by themselves too, but when they like.
  await registration.update();
};

// A browser that keeps nothing refuses, plain http has none of this, and the server may be away.
if (serviceWorker) register().catch(() => {});
