import { describe, expect, it } from 'vitest';
import { match, search } from './match';

const found = (query: string, texts: string[]) => search(query, texts, (text) => text).map((hit) => hit.entry);

describe('search', () => {
  it('finds letters in their order only', () => {
    expect(match('fbm', 'FB_Motor')).not.toBeNull();
    expect(match('mbf', 'FB_Motor')).toBeNull();
  });

  it('prefers beginnings, then words, then the rest', () => {
    expect(found('mot', ['Remote', 'FB_Motor', 'Motor'])).toEqual(['Motor', 'FB_Motor', 'Remote']);
  });

  it('takes initials of words and of camel case', () => {
    expect(found('go', ['Algorithm', 'GetOutput'])).toEqual(['GetOutput', 'Algorithm']);
    expect(match('go', 'GetOutput')!.at).toEqual([0, 3]);
  });

  it('marks what was matched', () => {
    expect(match('prg', 'PLC_PRG')!.at).toEqual([4, 5, 6]);
  });

  it('keeps the given order without a query', () => {
    expect(found('', ['b', 'a'])).toEqual(['b', 'a']);
  });
});
