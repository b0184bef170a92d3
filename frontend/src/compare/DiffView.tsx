import { ArrowDown, ArrowRightToLine, ArrowUp } from 'lucide-react';
import type { editor } from 'monaco-editor/editor/editor.api';
import { useEffect, useRef } from 'react';
import { useText } from '@/i18n';
import { EDITOR_OPTIONS } from '@/text/CodePane';
import { IEC_TEXT } from '@/text/iecText';
import type { Monaco } from '@/text/monacoLoader';
import { IconButton } from '@/ui/Button';
import { changeAt, takenBlock } from './comparison';
import styles from './DiffView.module.css';

interface DiffViewProps {
  monaco: Monaco;
  left: string;
  right: string;
  /** What the two sides are. */
  titles: readonly [string, string];
  /** Differences in blanks at the ends of lines are not shown. */
  ignoreWhiteSpace?: boolean;
  /** Makes the right side editable and hears of every change. */
  onRight?: (text: string) => void;
}

/** Two texts beside each other with their differences; blocks of the left one can be taken over into the right one. */
export function DiffView({ monaco, left, right, titles, ignoreWhiteSpace = false, onRight }: DiffViewProps) {
  const t = useText();
  const host = useRef<HTMLDivElement>(null);
  const sides = useRef<HTMLDivElement>(null);
  const view = useRef<{ diff: editor.IStandaloneDiffEditor; models: editor.IDiffEditorModel } | null>(null);
  const latest = useRef({ left, right, onRight });
  useEffect(() => {
    latest.current = { left, right, onRight };
  });
  const editable = onRight !== undefined;
  const [leftTitle, rightTitle] = titles;

  useEffect(() => {
    if (host.current === null) return;
    const diff = monaco.editor.createDiffEditor(host.current, {
      ...EDITOR_OPTIONS,
      // The sides stand in dialogs, whose buttons Tab leads to; no status bar could say another rule.
      tabFocusMode: true,
      readOnly: !editable,
      originalEditable: false,
      renderSideBySide: true,
      useInlineViewWhenSpaceIsLimited: false,
      ignoreTrimWhitespace: ignoreWhiteSpace,
      renderOverviewRuler: false,
      renderMarginRevertIcon: editable,
      folding: false,
      fixedOverflowWidgets: true,
      originalAriaLabel: leftTitle,
      modifiedAriaLabel: rightTitle,
    });
    const models = {
      original: monaco.editor.createModel(latest.current.left, IEC_TEXT),
      modified: monaco.editor.createModel(latest.current.right, IEC_TEXT),
    };
    view.current = { diff, models };
    diff.setModel(models);
    const listener = models.modified.onDidChangeContent(() => latest.current.onRight?.(models.modified.getValue()));
    const mine = diff.getModifiedEditor();
    // Titles of both sides come as labels of their text areas, too.
    diff.getOriginalEditor().updateOptions({ ariaLabel: leftTitle });
    mine.updateOptions({ ariaLabel: rightTitle });
    const layout = mine.onDidLayoutChange(() =>
      sides.current?.style.setProperty('--left', `${mine.getContainerDomNode().offsetLeft}px`),
    );
    return () => {
      view.current = null;
      layout.dispose();
      listener.dispose();
      diff.dispose();
      models.original.dispose();
      models.modified.dispose();
    };
  }, [monaco, editable, ignoreWhiteSpace, leftTitle, rightTitle]);

  useEffect(() => {
    const models = view.current?.models;
    if (models === undefined) return;
    if (models.original.getValue() !== left) models.original.setValue(left);
    if (models.modified.getValue() !== right) models.modified.setValue(right);
  }, [left, right, editable, monaco, ignoreWhiteSpace, leftTitle, rightTitle]);

  /** Acts on the differences, which are found in the background: at once, or when they are known. */
  const whenCompared = (act: () => void) => {
    const diff = view.current?.diff;
    if (diff === undefined) return;
    if (diff.getLineChanges() !== null) return act();
    const waiting = diff.onDidUpdateDiff(() => {
      waiting.dispose();
      whenCompared(act);
    });
  };
  const go = (way: 'next' | 'previous') => whenCompared(() => view.current?.diff.goToDiff(way));
  /** Puts the left side's lines in the place of the block that the cursor is in, or the next one. */
  const takeBlock = () => {
    if (view.current === null) return;
    const { diff, models } = view.current;
    const mine = diff.getModifiedEditor();
    const change = changeAt(diff.getLineChanges() ?? [], mine.getPosition()?.lineNumber ?? 1);
    if (change === undefined) return;
    const text = takenBlock(models.original.getValue(), models.modified.getValue(), change);
    mine.pushUndoStop();
    mine.executeEdits('take', [{ range: models.modified.getFullModelRange(), text }]);
    mine.pushUndoStop();
    mine.setPosition({ lineNumber: Math.max(1, change.modifiedStartLineNumber), column: 1 });
  };

  return (
    <div className={styles.view}>
      <div ref={sides} className={styles.sides}>
        <span className={styles.title}>{leftTitle}</span>
        <span className={styles.title}>{rightTitle}</span>
        <span className={styles.tools}>
          <IconButton small icon={ArrowUp} label={t('compare.previousBlock')} onClick={() => go('previous')} />
          <IconButton small icon={ArrowDown} label={t('compare.nextBlock')} onClick={() => go('next')} />
          {editable && (
            <IconButton
              small
              icon={ArrowRightToLine}
              label={t('compare.takeBlock')}
              onClick={() => whenCompared(takeBlock)}
            />
          )}
        </span>
      </div>
      <div ref={host} className={styles.host} />
    </div>
  );
}
