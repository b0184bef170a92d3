import { describe, expect, it } from 'vitest';
import { factsOf } from './facts';

describe('factsOf', () => {
  it('reads what stands above and in the header', () => {
    const declaration = [
      "{attribute 'qualified_only'}",
      "{attribute 'pack_mode' := '1'}",
      '(* Moves the axis. *)',
      '// Slowly.',
      'METHOD PRIVATE FINAL Move : BOOL',
      "VAR // {attribute 'not'} PUBLIC",
      'END_VAR',
    ].join('\n');
    expect(factsOf(declaration, 'Move := TRUE;')).toEqual({
      access: 'PRIVATE',
      modifiers: ['FINAL'],
      attributes: ["'qualified_only'", "'pack_mode' := '1'"],
      comment: 'Moves the axis.\nSlowly.',
      lines: 8,
      characters: declaration.length + 14,
    });
  });

  it('finds nothing in nothing', () => {
    expect(factsOf('', '')).toEqual({
      access: null,
      modifiers: [],
      attributes: [],
      comment: '',
      lines: 0,
      characters: 0,
    });
  });
});
