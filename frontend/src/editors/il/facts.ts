import { useEffect, useMemo, useState } from 'react';
import { activeLanguageClient } from '@/lsp/session';
import type { TextDocument } from '@/text/documents';
import { useModelText } from '@/text/useModelText';
import type { Monaco } from '@/text/monacoLoader';
import type { IlRow } from './rows';

/** What the declaration of an operand says; '' where it says nothing. */
export interface OperandFacts {
  readonly type: string;
  readonly address: string;
  readonly comment: string;
}

const PAUSE_MS = 250;
const MOST = 2000;

/** The operand of a row as it is asked for: without the comma or parenthesis behind it. */
export function operandName(row: IlRow): string {
  const jump = /^JMP/i.test(row.operator?.text ?? '');
  if (row.kind === 'label' || row.kind === 'raw' || jump) return '';
  return (row.operand?.text ?? '').replace(/^\(+|[\s,()]+$/g, '');
}

/** Type, address and comment of the operands, by upper-case name; requested again when declarations change. */
export function useOperandFacts(
  monaco: Monaco,
  document: TextDocument,
  rows: readonly IlRow[],
): ReadonlyMap<string, OperandFacts> {
  const [found, setFound] = useState<ReadonlyMap<string, OperandFacts>>(new Map());
  const declaration = useModelText(document.models.declaration);
  const names = useMemo(() => [...new Set(rows.map(operandName).filter((name) => name !== ''))].slice(0, MOST), [rows]);
  const [published, setPublished] = useState(0);
  useEffect(() => {
    // New messages anywhere: another text may have changed what an operand is.
    const listener = monaco.editor.onDidChangeMarkers(() => setPublished((count) => count + 1));
    return () => listener.dispose();
  }, [monaco]);
  useEffect(() => {
    let current = true;
    const uri = document.models.implementation.uri.toString();
    const timer = setTimeout(() => {
      void activeLanguageClient()
        ?.request<(OperandFacts | null)[]>('tappet/operandFacts', { textDocument: { uri }, operands: names })
        .then((answer) => {
          if (!current || answer === null) return;
          setFound(new Map(names.flatMap((name, at) => (answer[at] ? [[name.toUpperCase(), answer[at]]] : []))));
        });
    }, PAUSE_MS);
    return () => {
      current = false;
      clearTimeout(timer);
    };
  }, [document, names, declaration, published]);
  return found;
}
