import { describe, expect, it } from 'vitest';
import { declarationOf, optionsOf } from './declaration';

describe('declarations of new objects', () => {
  it('leave it to the template when nothing special is asked for', () => {
    expect(declarationOf('pou', 'program', 'P', {})).toBeNull();
    expect(declarationOf('pou', 'function_block', 'FB', { extends: ' ' })).toBeNull();
    expect(declarationOf('gvl', undefined, 'G', { returns: 'INT' })).toBeNull();
  });

  it('name base and interfaces of a function block', () => {
    expect(declarationOf('pou', 'function_block', 'FB', { extends: 'Base', implements: 'I1, I2' })).toMatch(
      /^FUNCTION_BLOCK FB EXTENDS Base IMPLEMENTS I1, I2\n/,
    );
  });

  it('name what a function answers', () => {
    expect(declarationOf('pou', 'function', 'F', { returns: 'LREAL' })).toMatch(/^FUNCTION F : LREAL\n/);
  });

  it('write methods without a type, and their access', () => {
    expect(declarationOf('method', undefined, 'M', { access: 'PRIVATE' })).toBe('METHOD PRIVATE M\nVAR_INPUT\nEND_VAR');
    expect(declarationOf('method', undefined, 'M', { returns: 'BOOL', access: 'PUBLIC' })).toBe(
      'METHOD M : BOOL\nVAR_INPUT\nEND_VAR',
    );
  });

  it('offer the options that count', () => {
    expect(optionsOf('pou', 'program')).toEqual([]);
    expect(optionsOf('dut', 'alias')).toEqual(['base']);
  });
});
