import { useEffect, useRef } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useLanguage } from '@/i18n';
import { useObjectSession } from '@/online/useObjectSession';
import type { Part } from '@/project/partUri';
import type { CodeEditor } from '@/text/CodePane';
import { guard } from '@/ui/notices';
import { breakpointLine, currentLine, lookOf, useDebugger } from '@/workbench/debugger/state';
import styles from './breakpoints.module.css';
import { toggleBreakpointAt } from './breakpointActs';

/** Monaco's target of a click on the numbers of lines, and beside them. */
const GUTTER_LINE_NUMBERS = 3;
const GUTTER_LINE_DECORATIONS = 4;

/** Breakpoints beside the lines of a text, and the line at which the task that is looked at stands. */
export function useBreakpoints(projectId: string, object: ObjectSummary, part: Part, editor: CodeEditor | null): void {
  const session = useObjectSession(projectId, object);
  const runtimeId = session?.runtimeId ?? null;
  const past = session?.past != null;
  const debugged = useDebugger(({ runtimes }) => (runtimeId === null ? undefined : runtimes[runtimeId]));
  const language = useLanguage();
  const objectId = object.id;

  useEffect(() => {
    if (editor === null || debugged === undefined) return;
    const of = { objectId, part };
    const marks = debugged.state.breakpoints.flatMap((one) => {
      const line = breakpointLine(one, of);
      if (line === null || one.order.kind !== 'line') return [];
      const said = [one.order.condition, one.order.log, one.reason].filter(Boolean).map((value) => ({ value: value! }));
      return [
        {
          range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
          options: {
            isWholeLine: true,
            marginClassName: `${styles.mark} ${styles[lookOf(one)]}`,
            className: one.verified && one.order.enabled ? styles.line : undefined,
            lineNumberHoverMessage: said,
            overviewRuler: { color: { id: 'editorOverviewRuler.errorForeground' }, position: 1 },
          },
        },
      ];
    });
    const now = currentLine(debugged, of);
    const current =
      now === null || past // where a task stands now says nothing about a past cycle
        ? []
        : [
            {
              range: { startLineNumber: now.line, startColumn: 1, endLineNumber: now.line, endColumn: 1 },
              options: {
                isWholeLine: true,
                zIndex: 10,
                className: now.innermost ? styles.current : styles.caller,
                marginClassName: now.innermost ? styles.arrow : styles.callerArrow,
                overviewRuler: { color: { id: 'editorOverviewRuler.warningForeground' }, position: 7 },
              },
            },
          ];
    const drawn = editor.createDecorationsCollection([...marks, ...current]);
    return () => drawn.clear();
  }, [editor, debugged, objectId, part, language, past]);

  const shown = useRef<string>('');
  useEffect(() => {
    const now = currentLine(debugged, { objectId, part });
    const key = now === null ? '' : `${String(debugged?.state.sequence)} ${String(now.line)}`;
    if (editor !== null && now !== null && key !== shown.current) editor.revealLineInCenterIfOutsideViewport(now.line);
    shown.current = key;
  }, [editor, debugged, objectId, part]);

  useEffect(() => {
    if (editor === null || runtimeId === null || part !== 'implementation') return;
    const click = editor.onMouseDown(({ target, event }) => {
      const type: number = target.type;
      const beside = type === GUTTER_LINE_NUMBERS || type === GUTTER_LINE_DECORATIONS;
      if (!beside || !event.leftButton || target.position === null) return;
      const line = target.position.lineNumber;
      void guard(() => toggleBreakpointAt(runtimeId, { objectId, part }, line));
    });
    return () => click.dispose();
  }, [editor, runtimeId, objectId, part]);
}
