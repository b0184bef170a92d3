import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import {
  canStore,
  cellsOf,
  filled,
  fitted,
  headerLogoBox,
  logoAddress,
  logoFrom,
  marginFault,
  PAPERS,
  PLACEHOLDERS,
  runningFault,
  sheetOf,
  TITLE_LOGO_BOX,
  USUAL,
} from './model';
import { SRC } from '../../../tests/sources';

const values = Object.fromEntries(PLACEHOLDERS.map((name) => [name, `<${name}>`])) as Parameters<typeof filled>[1];

test('the sheet turns', () => {
  expect(sheetOf({ paper: 'a4', orientation: 'portrait' })).toEqual([210, 297]);
  expect(sheetOf({ paper: 'us-letter', orientation: 'landscape' })).toEqual([279.4, 215.9]);
});

test('margins leave room for the text', () => {
  const margins = (changes: Partial<typeof USUAL.margins>) => ({ ...USUAL, margins: { ...USUAL.margins, ...changes } });
  expect(marginFault(USUAL, 'left')).toBeNull();
  for (const left of [4.9, 100.1, Number.NaN])
    expect(marginFault(margins({ left }), 'left')?.text).toBe('pageSetup.marginRange');
  const narrow = { ...margins({ left: 50, right: 40 }), paper: 'a5' as const };
  expect(marginFault(narrow, 'left')).toEqual({ text: 'pageSetup.marginsTooWide', values: { most: 88 } });
  expect(marginFault(narrow, 'top')).toBeNull();
  expect(canStore(narrow)).toBe(false);
  expect(canStore(margins({ left: 75, right: 75 }))).toBe(true);
});

test('placeholders are filled, two braces are one', () => {
  expect(filled('{project}: {{page} {page}/{pages}', values)).toBe('<project>: {page} <page>/<pages>');
  for (const name of PLACEHOLDERS) expect(runningFault(`a {${name}} b`)).toBeNull();
  expect(runningFault('x {nothing}')?.values).toEqual({ text: '{nothing}' });
  expect(runningFault('x {page')?.values).toEqual({ text: '{page' });
  expect(canStore({ ...USUAL, footer: { ...USUAL.footer, centre: '{' } })).toBe(false);
});

test('a logo is PNG or JPEG of a limited size', () => {
  const png = new Uint8Array([0x89, 0x50, 0x4e, 0x47, 1, 2, 3]);
  const read = logoFrom(png);
  expect(read).toEqual({ logo: btoa(String.fromCharCode(...png)) });
  expect(logoAddress('logo' in read ? read.logo : '')).toMatch(/^data:image\/png;base64,/);
  expect(logoAddress(btoa('\xff\xd8\xff\xe0'))).toMatch(/^data:image\/jpeg;/);
  expect(logoFrom(new TextEncoder().encode('<svg/>'))).toEqual({ fault: { text: 'pageSetup.logoFormat' } });
  const large = new Uint8Array(256 * 1024 + 1);
  expect(logoFrom(large)).toEqual({ fault: { text: 'pageSetup.logoTooLarge' } });
});

test('the defaults are those of the server', () => {
  const { components } = JSON.parse(readFileSync(join(SRC, 'api/openapi.json'), 'utf8')) as {
    components: { schemas: Record<string, { properties: Record<string, { default: unknown; enum?: string[] }> }> };
  };
  const { properties } = components.schemas.PageSetupData!;
  expect(Object.fromEntries(Object.entries(properties).map(([name, field]) => [name, field.default ?? null]))).toEqual(
    USUAL,
  );
  expect([...PAPERS].sort()).toEqual([...properties.paper!.enum!].sort());
});

test('heads and feet stand in columns', () => {
  const texts = { left: 'a', centre: '', right: 'b' };
  const parts = (...order: Parameters<typeof cellsOf>) =>
    cellsOf(...order).map(({ part, logo }) => `${part}${logo ? '*' : ''}`);
  expect(parts(texts, 'none')).toEqual(['left', 'right']);
  expect(parts({ ...texts, left: '' }, 'left')).toEqual(['left*', 'right']);
  expect(parts({ left: '', centre: 'c', right: '' }, 'none')).toEqual(['left', 'centre', 'right']);
  expect(parts({ left: '', centre: '', right: '' }, 'none')).toEqual([]);
});

test('a logo fits its places', () => {
  expect(fitted({ width: 300, height: 100 }, TITLE_LOGO_BOX)).toEqual([80, 80 / 3]);
  expect(fitted({ width: 10, height: 4000 }, headerLogoBox(5))[1]).toBe(3);
  expect(headerLogoBox(100)).toEqual([40, 10]);
});
