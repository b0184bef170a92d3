import { describe, expect, it } from 'vitest';
import { t } from '@/i18n';
import { exampleText } from './exampleText';

describe('texts of examples', () => {
  it('are in the language of the user where they are known', () => {
    const shear = { name: 'flying_shear', title: 'as in the file', description: 'as in the file' };
    expect(exampleText(t, shear).title).toBe('Flying shear');
    expect(exampleText(t, shear).description).not.toBe('as in the file');
  });

  it('are those of the project elsewhere', () => {
    const other = { name: 'press', title: 'Press', description: 'Presses.' };
    expect(exampleText(t, other)).toEqual({ title: 'Press', description: 'Presses.' });
  });
});
