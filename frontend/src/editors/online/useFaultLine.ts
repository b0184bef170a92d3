import { useEffect, useMemo } from 'react';
import type { ObjectSummary, RuntimeException } from '@/api/types';
import { useObjectSession } from '@/online/useObjectSession';
import { exceptionTitle } from '@/workbench/online/exception';
import type { Part } from '@/project/partUri';
import type { CodeEditor } from '@/text/CodePane';
import styles from './faultLine.module.css';

/** The line of a part at which the application stopped, or null. */
export function faultLine(exception: RuntimeException | null | undefined, objectId: string, part: Part): number | null {
  if (exception?.object_id !== objectId || exception.part !== part) return null;
  return exception.line;
}

/** A red line where the application stopped with an exception, as long as the exception lasts. */
export function useFaultLine(projectId: string, object: ObjectSummary, part: Part, editor: CodeEditor | null): void {
  const exception = useObjectSession(projectId, object)?.runtime?.exception;
  const line = faultLine(exception, object.id, part);
  const title = useMemo(() => (exception == null ? '' : exceptionTitle(exception)), [exception]);
  const message = exception?.message ?? '';
  useEffect(() => {
    if (editor === null || line === null) return;
    const marks = editor.createDecorationsCollection([
      {
        range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
        options: {
          isWholeLine: true,
          className: styles.line,
          linesDecorationsClassName: styles.mark,
          hoverMessage: [{ value: `**${title}**` }, { value: message }],
          overviewRuler: { color: { id: 'editorOverviewRuler.errorForeground' }, position: 4 },
        },
      },
    ]);
    return () => marks.clear();
  }, [editor, line, title, message]);
}
