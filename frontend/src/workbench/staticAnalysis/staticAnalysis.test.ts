import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { CodingRule } from '@/api/types';
import en from '@/i18n/en/analysis.json';
import zh from '@/i18n/zh/analysis.json';
import { groupsOf, isPrefix, levelOf, messageText, NO_RULES, onIn, withLevel, withLimit, withPrefix } from './model';

const rule = (code: string, message: string): CodingRule => ({
  code,
  name: '',
  numbers: code === 'S1211' ? ['SA0999'] : [],
  message,
  advice: '',
  prefixes: {},
  limits: {},
});
const rules = [rule('S1001', 'The name of {what}'), rule('S1004', 'No prefix'), rule('S1211', 'The number {value}')];
const title = (code: string) => (code === 'S1211' ? 'Magic number' : 'Prefix');

describe('static analysis settings', () => {
  it('keep only what is switched on', () => {
    const on = withLevel(NO_RULES, ['S1001', 'S1211'], 'error');
    expect(on.rules).toEqual({ S1001: 'error', S1211: 'error' });
    expect(levelOf(on, 'S1004')).toBe('off');
    expect(onIn(on, rules)).toBe(2);
    expect(withLevel(on, ['S1001', 'S1211'], 'off')).toEqual(NO_RULES);
  });

  it('keep only prefixes and limits that are not the usual ones', () => {
    const changed = withPrefix(withLimit(NO_RULES, 'nesting', 2, 4), 'BOOL', 'x', 'b');
    expect([changed.limits, changed.prefixes]).toEqual([{ nesting: 2 }, { BOOL: 'x' }]);
    expect(withPrefix(withLimit(changed, 'nesting', 4, 4), 'BOOL', 'b', 'b')).toEqual(NO_RULES);
    expect(withPrefix(NO_RULES, 'BOOL', '', 'b').prefixes).toEqual({ BOOL: '' });
    expect(['fb', '', 'a b', 'ä'].map(isPrefix)).toEqual([true, true, false, false]);
  });

  it('are found by code, title and message', () => {
    expect(groupsOf(rules, '', title).map((group) => group.id)).toEqual(['S10', 'S12']);
    expect(groupsOf(rules, 'magic', title)[0]?.rules.map((found) => found.code)).toEqual(['S1211']);
    expect(groupsOf(rules, 's1004', title)[0]?.rules).toHaveLength(1);
    expect(groupsOf(rules, 'sa0999', title)[0]?.rules[0]?.code).toBe('S1211');
    expect(groupsOf(rules, 'prefix nothing', title)).toEqual([]);
  });

  it('are described without the marks of the template', () => {
    expect(messageText("The name of {what} '{name}' is wrong")).toBe('The name of ‹what› ‹name› is wrong');
    expect(messageText('“{name}”有 {count} 个参数')).toBe('‹name›有 ‹count› 个参数');
    expect(messageText('‘{nobody}’')).toBe('‘‹nobody›’');
    expect(messageText("Write {{attribute 'strict'}} above")).toBe("Write {attribute 'strict'} above");
  });

  it('have a title in both languages for every rule of the compiler', () => {
    const table = readFileSync(join(import.meta.dirname, '../../../../backend/tappet/lang/diagnostics.csv'), 'utf8');
    const codes = [...table.matchAll(/^(S\d{4}),/gm)].map((match) => match[1]!);
    expect(codes.length).toBeGreaterThan(50);
    for (const texts of [en, zh] as Record<string, string>[]) {
      expect(codes.filter((code) => !texts[`rule.${code}`] || !texts[`ruleGroup.${code.slice(0, 3)}`])).toEqual([]);
    }
  });
});
