/** Names anywhere in the project, and the places that use one: asked of the language server, started when need be. */
import { loadMonaco } from '@/text/monacoLoader';
import type { LanguageClient } from './client';
import type { DocumentSymbol, Location, Position, Range } from './protocol';
import { languageClient } from './session';

export type Access = 'declaration' | 'read' | 'write' | 'call' | 'address';

export interface CrossReference {
  uri: string;
  range: Range;
  access: Access;
  /** What is named, with its owner. */
  symbol: string;
  /** The line of the place. */
  text: string;
}

export interface ProjectSymbol {
  name: string;
  kind: number;
  containerName?: string | null;
  location: Location;
}

async function clientOf(projectId: string): Promise<LanguageClient> {
  return languageClient(await loadMonaco(), projectId);
}

export async function projectSymbols(projectId: string, query: string): Promise<ProjectSymbol[]> {
  return (await (await clientOf(projectId)).request<ProjectSymbol[]>('workspace/symbol', { query })) ?? [];
}

export async function documentSymbols(projectId: string, uri: string): Promise<DocumentSymbol[]> {
  const params = { textDocument: { uri } };
  return (await (await clientOf(projectId)).request<DocumentSymbol[]>('textDocument/documentSymbol', params)) ?? [];
}

export type Question = { name: string } | { textDocument: { uri: string }; position: Position };

/** Throws with the server's reason when it cannot answer. */
export async function crossReferences(projectId: string, question: Question): Promise<CrossReference[]> {
  return (await clientOf(projectId)).demand<CrossReference[]>('tappet/crossReferences', question);
}
