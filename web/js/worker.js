// The dedicated workers: one owns the serial port, the other decodes dumps.
import init, { serve, serveDesk } from '../pkg/encoderscope.js';

await init();
if (self.name === 'desk') serveDesk(self);
else serve(self);
