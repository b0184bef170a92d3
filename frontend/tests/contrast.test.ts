/** Text colours of both themes reach 4.5:1 on every ground that text stands on (UI.md, Look). */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { themeFrom } from '@/text/theme';

const css = readFileSync(join(import.meta.dirname, '../src/app/tokens.css'), 'utf8');

function tokens(theme: string): Record<string, string> {
  const block = css.split('}').find((part) => part.includes(`data-theme='${theme}'`)) ?? '';
  return Object.fromEntries(
    [...block.matchAll(/--([\w-]+):\s*(#[0-9a-fA-F]+)/g)].map((match) => [match[1]!, match[2]!]),
  );
}

type Rgb = [number, number, number];

const channels = (hex: string) => [1, 3, 5, 7].map((at) => Number.parseInt(hex.slice(at, at + 2) || 'ff', 16));

/** A colour with transparency laid over another. */
function over(top: string, ground: Rgb): Rgb {
  const [r, g, b, alpha] = channels(top) as [number, number, number, number];
  const mix = (upper: number, lower: number) => (upper * alpha + lower * (255 - alpha)) / 255;
  return [mix(r, ground[0]), mix(g, ground[1]), mix(b, ground[2])];
}

function luminance(rgb: Rgb): number {
  const [r, g, b] = rgb.map((value) => {
    const part = value / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  }) as Rgb;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: Rgb, b: Rgb): number {
  const [light, dark] = [luminance(a), luminance(b)].sort((x, y) => y - x) as [number, number];
  return (light + 0.05) / (dark + 0.05);
}

const TEXT = ['fg', 'fg-muted', 'accent', 'ok', 'warn', 'error', 'forced', 'prepared', 'past', 'true', 'false'];
const GROUNDS = ['bg', 'bg-raised', 'bg-sunken', 'bg-float'];
/** Soft grounds carry text of their own colour: stripes, badges, pills. */
const SOFT = ['ok', 'warn', 'error', 'forced', 'prepared', 'past', 'true'];

describe.each(['light', 'dark'])('%s theme', (theme) => {
  const all = tokens(theme);
  const black: Rgb = [0, 0, 0];

  it.each(TEXT)('--%s is readable on every ground', (name) => {
    for (const ground of GROUNDS) {
      const ratio = contrast(over(all[name]!, black), over(all[ground]!, black));
      expect(ratio, `--${name} on --${ground}`).toBeGreaterThanOrEqual(4.5);
    }
  });

  it.each(SOFT)('--%s is readable on its soft ground', (name) => {
    const ground = over(all[`${name}-soft`]!, over(all.bg!, black));
    expect(contrast(over(all[name]!, black), ground), `--${name} on --${name}-soft`).toBeGreaterThanOrEqual(4.5);
  });

  it('text is readable on selections and on the accent', () => {
    const bg = over(all.bg!, black);
    for (const ground of ['bg-selected', 'bg-hover', 'bg-pressed', 'bg-selected-muted']) {
      expect(contrast(over(all.fg!, black), over(all[ground]!, bg)), ground).toBeGreaterThanOrEqual(4.5);
    }
    for (const ground of ['accent', 'accent-hover']) {
      expect(contrast(over(all['fg-on-accent']!, black), over(all[ground]!, black)), ground).toBeGreaterThanOrEqual(
        4.5,
      );
    }
  });
});

describe.each(['light', 'dark'])('%s theme of texts', (theme) => {
  const all = tokens(theme);
  const { rules, colors } = themeFrom((name) => all[name.slice(2)]!, theme === 'dark');

  it('has colours that the editor takes', () => {
    for (const [name, colour] of Object.entries(colors)) expect(colour, name).toMatch(/^#[0-9a-f]{6}([0-9a-f]{2})?$/i);
  });

  it.each(['inserted', 'removed'])('is readable in lines and words that were %s', (change) => {
    const line = over(colors[`diffEditor.${change}LineBackground`]!, over(all.bg!, [0, 0, 0]));
    const word = over(colors[`diffEditor.${change}TextBackground`]!, line);
    for (const { token, foreground } of rules)
      expect(contrast(over(`#${foreground!}`, word), word), token).toBeGreaterThanOrEqual(4.5);
  });
});

describe('both themes', () => {
  it('define the same tokens', () => {
    expect(Object.keys(tokens('dark')).sort()).toEqual(Object.keys(tokens('light')).sort());
  });
});
