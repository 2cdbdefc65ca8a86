// ../js/worker.js where all files are in the page itself: it sends the code of the module first.
import init, { serve, serveDesk } from '../pkg/encoderscope.js';

self.onmessage = async ({ data }) => {
  await init({ module_or_path: data });
  if (self.name === 'desk') serveDesk(self);
  else serve(self);
};
