import { useEffect, useMemo } from 'react';
import type { CodeEditor } from '@/text/CodePane';
import { bodyShown, useFlow } from '@/workbench/debugger/flow';
import { Executed } from './executed';
import styles from './executed.module.css';

interface ExecutedBody {
  runtimeId: string | null;
  objectId: string;
  /** Whether it is in front, shows live values, and is the text that runs. */
  shown: boolean;
}

/** What flow control has recorded of a body on screen; null without flow control. */
export function useExecuted({ runtimeId, objectId, shown }: ExecutedBody): Executed | null {
  const recorded = shown && runtimeId !== null ? runtimeId : null;
  useEffect(() => (recorded === null ? undefined : bodyShown(recorded, objectId)), [recorded, objectId]);
  const snapshot = useFlow(({ runtimes }) => (recorded === null ? undefined : runtimes[recorded]?.[objectId]));
  return useMemo(() => (snapshot === undefined ? null : new Executed(snapshot)), [snapshot]);
}

/** Executed lines of a text are tinted; they are drawn anew only where others were executed. */
export function useExecutedLines(editor: CodeEditor | null, executed: Executed | null): void {
  const lines = executed?.lines.join(' ') ?? '';
  useEffect(() => {
    if (editor === null || lines === '') return;
    const drawn = editor.createDecorationsCollection(
      lines
        .split(' ')
        .map(Number)
        .map((line) => ({
          range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
          options: { isWholeLine: true, className: styles.executed, linesDecorationsClassName: styles.bar },
        })),
    );
    return () => drawn.clear();
  }, [editor, lines]);
}
