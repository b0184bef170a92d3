/** The coding rules of an application as data: groups, search, switching on and off. Pure functions. */
import type { CodingRule, StaticAnalysisData } from '@/api/types';
import { textOf, type TextKey } from '@/i18n';

export const LEVELS = ['off', 'warning', 'error'] as const;
export type Level = (typeof LEVELS)[number];

export const NO_RULES: StaticAnalysisData = { with_build: true, rules: {}, prefixes: {}, limits: {} };

export interface RuleGroup {
  /** First three characters of the codes. */
  id: string;
  rules: readonly CodingRule[];
}

export function levelOf(chosen: StaticAnalysisData, code: string): Level {
  return chosen.rules[code] ?? 'off';
}

/** The settings with some rules at another level. */
export function withLevel(chosen: StaticAnalysisData, codes: Iterable<string>, level: Level): StaticAnalysisData {
  const rules = { ...chosen.rules };
  for (const code of codes) {
    if (level === 'off') delete rules[code];
    else rules[code] = level;
  }
  return { ...chosen, rules };
}

/** The settings with another prefix; the usual one is not stored. */
export function withPrefix(chosen: StaticAnalysisData, key: string, value: string, usual: string): StaticAnalysisData {
  const prefixes = { ...chosen.prefixes, [key]: value };
  if (value === usual) delete prefixes[key];
  return { ...chosen, prefixes };
}

/** The settings with another limit; the usual one is not stored. */
export function withLimit(chosen: StaticAnalysisData, key: string, value: number, usual: number): StaticAnalysisData {
  const limits = { ...chosen.limits, [key]: value };
  if (value === usual) delete limits[key];
  return { ...chosen, limits };
}

export function isPrefix(text: string): boolean {
  return /^[A-Za-z0-9_]{0,20}$/.test(text);
}

/** Whether the server takes the prefixes of a choice. */
export function prefixesFit(chosen: StaticAnalysisData): boolean {
  return Object.values(chosen.prefixes).every(isPrefix);
}

/** Rules that match a search by code, number in CODESYS, title or message, in groups. */
export function groupsOf(
  rules: readonly CodingRule[],
  search: string,
  titleOf: (code: string) => string,
): readonly RuleGroup[] {
  const words = search.trim().toLowerCase().split(/\s+/).filter(Boolean);
  const groups = new Map<string, CodingRule[]>();
  for (const rule of rules) {
    const text = [rule.code, ...rule.numbers, titleOf(rule.code), rule.message].join(' ').toLowerCase();
    if (!words.every((word) => text.includes(word))) continue;
    const id = rule.code.slice(0, 3);
    groups.set(id, [...(groups.get(id) ?? []), rule]);
  }
  return [...groups].map(([id, found]) => ({ id, rules: found }));
}

/** How many rules are on. */
export function onIn(chosen: StaticAnalysisData, rules: readonly CodingRule[]): number {
  return rules.filter((rule) => levelOf(chosen, rule.code) !== 'off').length;
}

/** A message of the table for people: what is filled in later is a word in angle marks, braces stand once. */
export function messageText(message: string): string {
  const word = (_: string, field: string) => `‹${textOf(`field.${field}`) ?? field}›`;
  return message.replace(/['“]?(?<!\{)\{(\w+)\}(?!\})['”]?/g, word).replace(/([{}])\1/g, '$1');
}

/** Keys of texts; the codes come from the server, and each has its two texts. */
export const titleKey = (code: string) => `rule.${code}` as TextKey;
export const groupKey = (id: string) => `ruleGroup.${id}` as TextKey;
export const limitKey = (key: string) => `ruleLimit.${key}` as TextKey;
