/** The warnings of the compiler that an application does not report. Pure functions. */
import type { CompilerWarning } from '@/api/types';

/** Warnings that match all words of a search, in code, number in CODESYS or text. */
export function matching(warnings: readonly CompilerWarning[], search: string): readonly CompilerWarning[] {
  const words = search.trim().toLowerCase().split(/\s+/).filter(Boolean);
  return warnings.filter(({ code, numbers, message, advice }) => {
    const text = [code, ...numbers, message, advice].join(' ').toLowerCase();
    return words.every((word) => text.includes(word));
  });
}

/** The codes that are off after some are switched, each once and in the order that the server stores. */
export function switched(off: readonly string[], codes: readonly string[], on: boolean): string[] {
  const left = new Set(off);
  for (const code of codes) {
    if (on) left.delete(code);
    else left.add(code);
  }
  return [...left].sort();
}

/** Whether a message of this code can be switched off: errors and coding rules cannot. */
export function isCompilerWarning(code: string, severity: string): boolean {
  return severity !== 'error' && /^W\d{4}$/.test(code);
}
