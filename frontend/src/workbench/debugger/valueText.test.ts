import { describe, expect, it } from 'vitest';
import { valueText } from './valueText';

describe('the value of a variable of a frame', () => {
  it('is its literal', () => {
    expect(valueText({ literal: 'T#5ms', value: 5 })).toBe('T#5ms');
  });

  it('is written like an initial value where it has parts', () => {
    const value = { xOn: true, lrSpeed: 1.5, axes: [{ n: 1 }, { n: -2 }], text: "it's $5" };
    expect(valueText({ literal: '', value })).toBe(
      "(xOn := TRUE, lrSpeed := 1.5, axes := [(n := 1), (n := -2)], text := 'it$'s $$5')",
    );
  });

  it('is a dash where nothing can be read', () => {
    expect(valueText({ literal: '', value: null })).toBe('–');
  });
});
