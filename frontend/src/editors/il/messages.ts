import type { editor } from 'monaco-editor/editor/editor.api';
import { useEffect, useMemo, useState } from 'react';
import type { Monaco } from '@/text/monacoLoader';
import { rowAt, type IlRow } from './rows';

export interface RowMessage {
  readonly severity: 'error' | 'warning' | 'info';
  readonly message: string;
  /** Column in its line, from 1. */
  readonly column: number;
}

/** What the compiler says about the text, by row. */
export function useRowMessages(
  monaco: Monaco,
  model: editor.ITextModel,
  rows: readonly IlRow[],
): ReadonlyMap<number, readonly RowMessage[]> {
  const [markers, setMarkers] = useState<readonly editor.IMarker[]>([]);
  useEffect(() => {
    const read = () => setMarkers(monaco.editor.getModelMarkers({ resource: model.uri }));
    const listener = monaco.editor.onDidChangeMarkers((changed) => {
      if (changed.some((uri) => uri.toString() === model.uri.toString())) read();
    });
    queueMicrotask(read);
    return () => listener.dispose();
  }, [monaco, model]);
  return useMemo(() => messagesByRow(markers, rows), [markers, rows]);
}

export function messagesByRow(
  markers: readonly Pick<editor.IMarkerData, 'severity' | 'message' | 'startLineNumber' | 'startColumn'>[],
  rows: readonly IlRow[],
): ReadonlyMap<number, readonly RowMessage[]> {
  const found = new Map<number, RowMessage[]>();
  for (const { severity, message, startLineNumber, startColumn } of markers) {
    const row = rowAt(rows, startLineNumber, startColumn);
    const entry: RowMessage = {
      severity: severityOf(severity),
      message,
      column: startColumn,
    };
    found.set(row, [...(found.get(row) ?? []), entry]);
  }
  return found;
}

/** Monaco's numbers: Error 8, Warning 4. */
function severityOf(number: number): RowMessage['severity'] {
  return number >= 8 ? 'error' : number >= 4 ? 'warning' : 'info';
}
