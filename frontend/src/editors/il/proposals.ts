/** What may stand in a cell of the table: asked of the language server with the text as it would be. */
import { activeLanguageClient } from '@/lsp/session';
import type { CompletionItem, CompletionList, Position } from '@/lsp/protocol';
import type { TextDocument } from '@/text/documents';
import type { Proposal, Propose } from '@/ui/grid/useProposals';
import { setCell } from './edits';
import { parseRows, type IlColumn } from './rows';

const MOST_SHOWN = 100;
const SNIPPET = 2;
/** Stands at the caret while the server is asked: an empty cell has no place in the text. */
const HERE = 'Q_';

interface Trial {
  readonly text: string;
  /** Where the content of the cell begins. */
  readonly start: number;
}

/** The text as it would be with `typed` in a cell. */
export function trial(text: string, row: number, column: IlColumn, typed: string): Trial | null {
  const before = parseRows(text)[row];
  if (before === undefined) return null;
  const content = typed.trimStart() + HERE;
  const made = setCell(text, row, column, content);
  const start = made.indexOf(content, before.start);
  return start < 0 ? null : { text: made, start: start - (typed.length - typed.trimStart().length) };
}

export function positionAt(text: string, offset: number): Position {
  const before = text.slice(0, offset);
  return { line: before.split('\n').length - 1, character: offset - (before.lastIndexOf('\n') + 1) };
}

/** The answers that go on with what is typed, those that begin with it first. */
export function fitting(items: readonly CompletionItem[], cell: string, caret: number, cellColumn: number): Proposal[] {
  const proposals = items.flatMap((item): (Proposal & { typed: string })[] => {
    const edit = item.textEdit;
    if (item.insertTextFormat === SNIPPET || edit === undefined || !('range' in edit)) return [];
    const start = Math.max(0, Math.min(caret, edit.range.start.character - cellColumn));
    const typed = cell.slice(start, caret).toUpperCase();
    return [{ label: item.label, detail: item.detail ?? '', insert: edit.newText, start, typed }];
  });
  const rank = ({ label, typed }: { label: string; typed: string }) => label.toUpperCase().indexOf(typed);
  // An operator of IL comes before the function of its name.
  const labels = new Set<string>();
  const single = proposals.filter(({ label }) => !labels.has(label) && labels.add(label));
  const begins = single.filter((one) => rank(one) === 0);
  const holds = single.filter((one) => rank(one) > 0);
  return [...begins, ...holds]
    .slice(0, MOST_SHOWN)
    .map(({ label, detail, insert, start }) => ({ label, detail, insert, start }));
}

/** Proposals for one cell; while a word is typed on, the first answer is kept. */
export function proposer(document: TextDocument, row: number, column: IlColumn): Propose {
  const model = document.models.implementation;
  let known: { before: string; answer: Promise<readonly CompletionItem[]>; column: number } | null = null;
  return async (cell, caret) => {
    const before = cell.slice(0, caret).replace(/[\p{L}\p{N}_]*$/u, '');
    if (known?.before !== before) {
      const tried = trial(model.getValue(), row, column, before);
      if (tried === null) return [];
      const position = positionAt(tried.text, tried.start + before.length);
      const params = { textDocument: { uri: model.uri.toString() }, position, text: tried.text };
      const answer = activeLanguageClient()
        ?.request<CompletionList>('tappet/completionIn', params)
        .then((list) => list?.items ?? []);
      known = {
        before,
        answer: answer ?? Promise.resolve([]),
        column: position.character - before.length,
      };
    }
    return fitting(await known.answer, cell, caret, known.column);
  };
}
