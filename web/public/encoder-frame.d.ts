/** `<encoder-frame>`: bits and fields of an absolute encoder's frame, to point at and to change. */

import type { Frame } from './encoderscope.js';

/** What a frame says after a change. */
export interface FrameRecord extends Frame {
  /** The frame in digits, as the attribute `frame` takes it. */
  frame: string;
}

/**
 * Importing the module defines the element once its WASM is there. Its attributes are the
 * parameters of a `Profile` in kebab-case (`format`, `angle-bits`, `model`, `layout`, …) and
 *
 * - `frame`: hexadecimal digits, or 0 and 1; left out, the example of the format;
 * - `direction`: `sent` for a request, `received` for a reply;
 * - `readonly`: bits cannot be changed;
 * - `checks="stay"`: CRC and parity stay as they are when something else is changed;
 * - `theme`: `light` or `dark` instead of what the system prefers; `page` for the color scheme of
 *   the page around;
 * - `lang`: the language, `en` or `ru`; what is not English comes from `ru.json` beside the module.
 *
 * Colours and fonts are the custom properties `--encoder-frame-panel`, `-ink`, `-dim`, `-line`,
 * `-good`, `-warn`, `-bad`, `-turns`, `-angle`, `-flags`, `-status`, `-check`, `-framing`, `-sans`
 * and `-mono`. What stands inside the element is shown until it is ready, and where it cannot be.
 */
export class EncoderFrame extends HTMLElement {
  /** The frame as it is now, in digits; setting it sets the attribute. */
  frame: string;
  /** What the frame says; null where the attributes are wrong. */
  readonly record: FrameRecord | null;
  readonly readOnly: boolean;
  readonly checks: 'follow' | 'stay';
  /** Turns a bit over, as a click does. */
  flip(index: number): void;
  addEventListener(
    type: 'change',
    listener: (this: EncoderFrame, event: CustomEvent<FrameRecord>) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

declare global {
  interface HTMLElementTagNameMap {
    'encoder-frame': EncoderFrame;
  }
}
