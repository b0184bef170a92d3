/** Where quick open gets names inside of objects from: the language client registers itself here. */
import type { Part } from '@/project/partUri';

/** Positions count from 0, as in the Language Server Protocol. */
interface SymbolRange {
  start: { line: number; character: number };
}

export interface ProjectSymbol {
  name: string;
  /** `SymbolKind` of the protocol. */
  kind: number;
  location: { uri: string; range: SymbolRange };
}

export interface MemberSymbol {
  name: string;
  kind: number;
  detail?: string | null;
  selectionRange: SymbolRange;
  children?: readonly MemberSymbol[] | null;
}

export interface SymbolSource {
  /** Names anywhere in the project that fit the query. */
  project: (projectId: string, query: string) => Promise<readonly ProjectSymbol[]>;
  /** What one text of an object declares. */
  members: (projectId: string, objectId: string, part: Part) => Promise<readonly MemberSymbol[]>;
}

let source: SymbolSource | null = null;

export function setSymbolSource(symbols: SymbolSource): void {
  source = symbols;
}

export function symbolSource(): SymbolSource | null {
  return source;
}
