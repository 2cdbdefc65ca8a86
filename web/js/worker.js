// The dedicated worker that owns the serial port.
import init, { serve } from '../pkg/encoderscope.js';

await init();
serve();
