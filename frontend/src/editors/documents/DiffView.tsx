import type { editor } from 'monaco-editor/editor/editor.api';
import { useEffect, useRef } from 'react';
import { EDITOR_OPTIONS } from '@/text/CodePane';
import { IEC_TEXT } from '@/text/iecText';
import type { Monaco } from '@/text/monacoLoader';
import styles from './DocumentBars.module.css';

interface DiffViewProps {
  monaco: Monaco;
  left: string;
  right: string;
  /** Makes the right side editable and hears of every change. */
  onRight?: (text: string) => void;
}

/** Two texts beside each other with their differences. */
export function DiffView({ monaco, left, right, onRight }: DiffViewProps) {
  const host = useRef<HTMLDivElement>(null);
  const models = useRef<editor.IDiffEditorModel | null>(null);
  const latest = useRef(onRight);
  useEffect(() => {
    latest.current = onRight;
  });
  const editable = onRight !== undefined;

  useEffect(() => {
    if (host.current === null) return;
    const diff = monaco.editor.createDiffEditor(host.current, {
      ...EDITOR_OPTIONS,
      readOnly: !editable,
      originalEditable: false,
      renderSideBySide: true,
      useInlineViewWhenSpaceIsLimited: false,
      ignoreTrimWhitespace: false,
      renderOverviewRuler: false,
      renderMarginRevertIcon: editable,
      folding: false,
      fixedOverflowWidgets: true,
    });
    const pair = {
      original: monaco.editor.createModel('', IEC_TEXT),
      modified: monaco.editor.createModel('', IEC_TEXT),
    };
    models.current = pair;
    diff.setModel(pair);
    const listener = pair.modified.onDidChangeContent(() => latest.current?.(pair.modified.getValue()));
    return () => {
      models.current = null;
      listener.dispose();
      diff.dispose();
      pair.original.dispose();
      pair.modified.dispose();
    };
  }, [monaco, editable]);

  useEffect(() => {
    const pair = models.current;
    if (pair === null) return;
    if (pair.original.getValue() !== left) pair.original.setValue(left);
    if (pair.modified.getValue() !== right) pair.modified.setValue(right);
  }, [left, right, editable, monaco]);

  return <div ref={host} className={styles.host} />;
}
