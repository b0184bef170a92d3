import type { editor } from 'monaco-editor/editor/editor.api';
import { useCallback, useEffect, useState } from 'react';
import { followRightClick, TextMenu } from '@/editors/text/TextMenu';
import { useText } from '@/i18n';
import { CodePane, type CodeEditor } from '@/text/CodePane';
import { addPanelEditor, removePanelEditor } from '@/text/focus';
import type { Monaco } from '@/text/monacoLoader';
import styles from './Cnc.module.css';
import type { CncDocument } from './cncDocument';

interface CncTextProps {
  panelId: string;
  monaco: Monaco;
  program: CncDocument;
  name: string;
  readOnly: boolean;
  /** The block that is chosen, from 0. */
  line: number;
  /** Shows the block that is chosen elsewhere (CNC-31). */
  follows: boolean;
  onLine: (line: number) => void;
  onEditor: (editor: CodeEditor | null) => void;
}

/** The program as text. */
export function CncText(props: CncTextProps) {
  const { panelId, monaco, program, name, readOnly, line, follows, onLine, onEditor } = props;
  const t = useText();
  const [shown, setShown] = useState<CodeEditor | null>(null);
  const made = useCallback(
    (next: CodeEditor | null) => {
      if (next === null) removePanelEditor(panelId, 'implementation');
      else {
        addPanelEditor(panelId, 'implementation', next);
        followRightClick(next);
      }
      setShown(next);
      onEditor(next);
    },
    [panelId, onEditor],
  );
  useEffect(() => {
    if (shown === null) return;
    const cursor = shown.onDidChangeCursorPosition(({ position }) => {
      if (shown.hasTextFocus()) onLine(position.lineNumber - 1);
    });
    return () => cursor.dispose();
  }, [shown, onLine]);
  useEffect(() => {
    if (shown === null || !follows || shown.hasTextFocus()) return;
    const lineNumber = Math.min(line + 1, program.model.getLineCount());
    const range = { startLineNumber: lineNumber, endLineNumber: lineNumber, startColumn: 1, endColumn: 1 };
    const options: editor.IModelDecorationOptions = { isWholeLine: true, className: styles.chosen };
    const marked = shown.createDecorationsCollection([{ range, options }]);
    shown.revealLineInCenterIfOutsideViewport(lineNumber);
    return () => marked.clear();
  }, [shown, follows, line, program]);
  return (
    <TextMenu panelId={panelId}>
      <CodePane
        monaco={monaco}
        model={program.model}
        label={t('cnc.textOf', { name })}
        readOnly={readOnly}
        onEditor={made}
      />
    </TextMenu>
  );
}
