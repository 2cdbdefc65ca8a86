// The guided settings, with every format that offers them.
import { at, expect } from '../page/page.js';

const RS485 = 'format=rs485&angle-bits=24&command=s';
const BUS = 'format=bus&angle-bits=24';
const T485 = 'format=t485&angle-bits=23';
const TAMAGAWA = 'format=t485&angle-bits=17&dialect=tamagawa';

/** Presses a door of the settings; the shaft is known to stand still before it is confirmed. */
const door = (name) => async (page) => {
  await page.getByRole('button', { name: `${name}…` }).click();
  const gate = at(page, 'gate');
  if ((await gate.count()) > 0) await expect(gate).toHaveAttribute('data-value', 'true');
};

const setAddress = async (page) => {
  await door('Set address')(page);
  await page.locator('input[name=new-address]').fill('7');
};

const CELL = 0x10;

const writeMemory = async (page) => {
  await page.locator('input[name=memory-address]').fill(`${CELL}`);
  await at(page, 'memory-read').click();
  await expect(at(page, 'memory-cell')).toHaveAttribute('data-value', '0');
  await page.locator('input[name=memory-byte]').fill('165');
  await at(page, 'memory-write').click();
};

// The shaft is at 5.25 turns, and there is an error. `made` says of what an encoder told in the end
// whether the change was made in it.
export const SETTINGS = [
  { setting: 'set zero, RS485', query: RS485, open: door('Set zero'), made: ({ turns, angle }) => turns === 0 && angle === 0 },
  { setting: 'set zero, BUS', query: BUS, open: door('Set zero'), made: ({ turns, angle }) => turns === 0 && angle === 0 },
  { setting: 'reset angle, T485', query: T485, open: door('Reset angle'), made: ({ angle }) => angle === 0 },
  { setting: 'reset turns, T485', query: T485, open: door('Reset turns'), made: ({ turns }) => turns === 0 },
  { setting: 'reset errors, T485', query: TAMAGAWA, open: door('Reset errors'), made: ({ error }) => !error },
  { setting: 'write EEPROM, T485', query: TAMAGAWA, open: writeMemory, made: ({ memory }) => memory[CELL] === 165 },
  { setting: 'set address, BUS', query: BUS, open: setAddress, made: ({ address }) => address === 7 },
];

