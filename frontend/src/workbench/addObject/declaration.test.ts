import { describe, expect, it } from 'vitest';
import { kindOf, type AddValues } from '@/project/kinds';
import { declarationOf } from './declaration';

const made = (kind: string, subkind: string | undefined, name: string, values: AddValues) =>
  declarationOf(kind, { subkind, name, values });

describe('declarations of new objects', () => {
  it('leave it to the template when nothing special is asked for', () => {
    expect(made('pou', 'program', 'P', {})).toBeNull();
    expect(made('pou', 'function_block', 'FB', { extends: ' ' })).toBeNull();
    expect(made('gvl', undefined, 'G', { returns: 'INT' })).toBeNull();
  });

  it('name base and interfaces of a function block', () => {
    expect(made('pou', 'function_block', 'FB', { extends: 'Base', implements: 'I1, I2' })).toMatch(
      /^FUNCTION_BLOCK FB EXTENDS Base IMPLEMENTS I1, I2\n/,
    );
  });

  it('name what a function answers', () => {
    expect(made('pou', 'function', 'F', { returns: 'LREAL' })).toMatch(/^FUNCTION F : LREAL\n/);
  });

  it('write methods without a type, and their access', () => {
    expect(made('method', undefined, 'M', { access: 'PRIVATE' })).toBe('METHOD PRIVATE M\nVAR_INPUT\nEND_VAR');
    expect(made('method', undefined, 'M', { returns: 'BOOL', access: 'PUBLIC' })).toBe(
      'METHOD M : BOOL\nVAR_INPUT\nEND_VAR',
    );
  });

  it('offer the options that count', () => {
    expect(kindOf('pou')?.add?.optionsOf?.('program')).toEqual([]);
    expect(kindOf('dut')?.add?.optionsOf?.('alias')).toEqual(['base']);
  });
});
