/** Decodes, explains and encodes frames of absolute rotary encoders. */

export type Format =
  | 'ssi' | 'biss-c' | 'rs485' | 't485' | 'bus' | 'period' | 'asi1' | 'asi4' | 'ssi7' | 'ssi-tree'
  | 'own';

/** Parameters of an encoder; omitted ones take the format's default. */
export interface Profile {
  format?: Format;
  /** An order code instead of the rest. */
  model?: string;
  /** Own layouts: the layout as text, or the name of one that comes with the program. */
  layout?: string;
  angleBits?: number;
  turnsBits?: number;
  /** How the turn counter is read; `unsigned` unless said otherwise. */
  turnsCode?: 'unsigned' | 'signed';
  /** BiSS-C. */
  statusBits?: number;
  /** BiSS-C: the level of a status bit that says the condition is there. */
  statusActive?: 'high' | 'low';
  /** BiSS-C. */
  ackBits?: number;
  /** RS485: the command whose replies are read. */
  command?: '0' | '1' | 'd' | 's' | 't';
  /** BUS: address of the device, 0…31. */
  address?: number | null;
  /** SSI fir-tree: `gray` unless said otherwise. */
  code?: 'gray' | 'binary';
  /** SSI fir-tree: `tree` unless said otherwise. */
  align?: 'tree' | 'right';
  /** SSI fir-tree: bits of a word, 25, or 13 without turns. SSI7: 30. */
  frameBits?: number;
  /** SSI fir-tree: `none` unless said otherwise. BUS: `odd`. */
  parity?: 'none' | 'even' | 'odd';
  /** T485: whose meaning the alarm byte has. */
  dialect?: 'mpp' | 'tamagawa';
  /** ASI1: the top bits that are encoded; any are read. */
  marker?: 'none' | 'first';
  baud?: number;
  /** Bit formats: `left` is an SPI capture (the default of BiSS-C), `right` a number. */
  justify?: 'left' | 'right';
}

export interface Checked {
  expected: number;
  received: number;
  ok: boolean;
}

/** A frame; quantities that the format may have and this frame has not are null. */
export interface Frame {
  /** Offset in the input: bytes, or bits for strings of 0 and 1. */
  start: number;
  hex: string;
  /** Every check of the frame holds. */
  ok: boolean;
  turns: number | null;
  /** Counts within one turn. */
  angle: number | null;
  degrees: number | null;
  error: boolean | null;
  warning: boolean | null;
  /** The six status bits; T485: the SF byte. */
  status: number | null;
  crc: Checked | null;
  /** BUS: what the manual leaves open, so that it may fail in a frame that is ok. */
  parity?: Checked | null;
  /** °C */
  temperature?: number | null;
  /** rev/s */
  speed?: number | null;
  /** ASI1: the position is valid. */
  valid?: boolean | null;
  /** ASI1: no zero has been set by the user. */
  zeroDefault?: boolean | null;
  /** BUS: the device that answers. */
  address?: number;
  /** T485: the data ID; BUS: 0 get, 1 set zero, 2 set address. */
  operation?: number | null;
  count?: number | null;
  enid?: number | null;
  alarm?: number | null;
  memoryAddress?: number | null;
  memoryData?: number | null;
  /** What is wrong, in words. */
  faults?: string[];
}

export interface Decoded {
  frames: Frame[];
  skips: { start: number; hex: string; why: string }[];
  /** Tokens of the text that could not be read. */
  unread: string[];
  summary: { bytes: number; frames: number; bad: number; skipped: number };
}

export interface Note {
  name: string;
  class: 'turns' | 'angle' | 'flags' | 'status' | 'check' | 'framing';
  /** Where the field stands, most significant part first. */
  spans: { start: number; len: number }[];
  doc: string;
  raw: number;
  text: string;
  bits: { at: number; name: string; set: boolean; doc: string }[];
  fault: string | null;
}

export interface FormatInfo {
  format: Format;
  title: string;
  /** The parameters that matter to the format. */
  parameters: string[];
  profile: Profile;
}

/** Numbers to encode; omitted ones are 0 or not asserted. */
export interface Values {
  turns?: number;
  angle?: number;
  error?: boolean;
  warning?: boolean;
  status?: number;
  alarm?: number;
  enid?: number;
  speed?: number;
  temperature?: number;
  count?: number;
  valid?: boolean;
  zeroDefault?: boolean;
  address?: number;
  /** Chooses between the frames of T485 and of BUS. */
  operation?: number;
  memoryAddress?: number;
  memoryData?: number;
}

/** All formats with their default profiles. */
export function formats(): FormatInfo[];

/** Decodes pasted text. Throws only when the profile is wrong. */
export function decode(profile: Profile, text: string): Decoded;

/** Readings of good frames, a number after the other; the same index is the same frame. */
export interface Columns {
  /** Counts within one turn; the lowest bits of more than 53 are lost. */
  angle: Float64Array;
  /** Whole turns; 0 where the encoder counts none. */
  turns: Float64Array;
  /** The status bits; 0 where the frame has none. */
  status: Uint8Array;
  /** What the encoder says of the position: 0 good, 1 warning, 2 error, 3 both. */
  health: Uint8Array;
  /** Where they stand in a stream of bytes: `frames` frames of `len` bytes each, the first at `start`. */
  runs: { start: Float64Array; len: Uint32Array; frames: Uint32Array };
  /** Counts since the reader was made; what is in no frame is skipped. */
  summary: { bytes: number; frames: number; bad: number; skipped: number };
}

/**
 * Decodes bytes as they came, or text as it was pasted, into columns: much faster than `decode`,
 * which makes an object for each frame. Bytes of clocked formats are words, each of as many whole
 * bytes as a frame needs. Throws only when the profile is wrong.
 */
export function decodeColumns(profile: Profile, input: Uint8Array | string): Columns;

/** Decodes input that comes in pieces, of any length together, into columns. */
export class ColumnReader {
  constructor(profile: Profile);
  /** Decodes more bytes, cut anywhere; of clocked formats whole words. */
  push(bytes: Uint8Array): void;
  /** Takes more of a pasted text, cut anywhere; what is in it is decoded when it ends. */
  pushText(text: string): void;
  /** The input has ended; decodes what is left. What is pushed then is another input. */
  finish(): void;
  /** How many readings there are to take. */
  readonly length: number;
  /** Hands the readings over, and forgets them. */
  take(): Columns;
  /** Forgets the readings. */
  clear(): void;
  /** Gives its memory back; it is of no use then. */
  free(): void;
}

/** A profile that the text may be, with how sure that is and why. */
export interface Candidate extends Profile {
  verdict: 'certain' | 'likely' | 'ambiguous' | 'unlikely';
  evidence: string[];
  /** A mistake of the capture that must be undone first. */
  change?: 'reversed' | 'inverted' | 'clock-early' | 'clock-late' | 'missing-byte' | 'hex-text';
}

/** Ranks what pasted text may be, best first; empty where more speaks against than for. */
export function detect(text: string): Candidate[];

/** Explains one whole frame, field by field. */
export function explain(profile: Profile, hexOrBits: string): Note[];

/** The frame that says `values`: hexadecimal digits, or 0 and 1 where it is not whole bytes. */
export function encode(profile: Profile, values: Values): string;

/** What an order code says: its profile, and what else follows. */
export interface Model extends Profile {
  /** The series; `MPP or PT` of a short form such as `17M-T`. */
  series: string;
  /** The code as it is ordered, in capital letters. */
  orderCode: string;
  /** The interface; `rs485` and `rs422` share the format `rs485`, but not the wires. */
  interface: string;
  turnsKept: 'none' | 'powered' | 'battery' | 'flash' | 'gear';
  /** Whether it has wires for a battery. */
  battery: boolean;
  /** Whether zero or address can be changed by command. */
  changesByCommand: boolean;
  supply: string | null;
  current: string | null;
  /** Working temperature, °C. */
  leastTemperature: number | null;
  greatestTemperature: number | null;
  /** Diameters, mm. */
  rotor: number | null;
  stator: number | null;
  /** Bits of the frame that is read most, where it always has as many; of BiSS-C without its preamble. */
  frameBits?: number;
}

/** What an order code says; throws with the part that is wrong. */
export function parseModel(code: string): Model;
