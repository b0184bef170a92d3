/** Variables of a program (VAR-01). */

const NAME = /\$([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*)\$/g;

/** The names between dollar signs in the order of their first use, each once, and further ones behind them. */
export function usedVariables(lines: readonly string[], others: readonly string[] = []): string[] {
  const names = new Map<string, string>();
  const add = (name: string) => names.has(name.toLowerCase()) || names.set(name.toLowerCase(), name);
  for (const line of lines) if (line.includes('$')) for (const match of line.matchAll(NAME)) add(match[1]!);
  others.forEach(add);
  return [...names.values()];
}
