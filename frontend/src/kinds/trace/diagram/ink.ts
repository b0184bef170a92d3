/** Colours of the theme for what is drawn on a canvas. */
import type { Ink } from './plot';

const AUTOMATIC = 10;

export function themeInk(): Ink {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return {
    text: of('--fg-muted'),
    line: of('--line-strong'),
    grid: of('--line'),
    trigger: of('--warn'),
    font: of('--font-ui'),
  };
}

/** Token of the colour that a variable has by itself (TRC-41). */
export function automaticColor(number: number): string {
  return `var(--curve-${(number % AUTOMATIC) + 1})`;
}

/** A colour as a canvas takes it: tokens are looked up. */
export function canvasColor(color: string): string {
  const token = /^var\((--[\w-]+)\)$/.exec(color);
  return token ? getComputedStyle(document.documentElement).getPropertyValue(token[1]!).trim() : color;
}

/** The same, each colour looked up once: that makes the browser compute its styles. */
export function canvasColors(): (color: string) => string {
  const known = new Map<string, string>();
  return (color) => {
    const found = known.get(color) ?? canvasColor(color);
    known.set(color, found);
    return found;
  };
}
