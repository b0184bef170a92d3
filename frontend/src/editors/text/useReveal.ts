import { useEffect } from 'react';
import type { Reveal } from '@/project/editorProps';
import { panelEditor, panelEditorOf, panelTable, showPanelPart } from '@/text/focus';

/** Carries out a jump into an editor; the editor may appear a moment later (the table gives way to the text). */
export function useReveal(panelId: string, reveal: Reveal | null): void {
  useEffect(() => {
    // A table of the body carries out its jumps itself.
    const inTable = reveal?.part !== 'declaration' && panelTable(panelId)?.jumps === true;
    if (reveal === null || inTable) return;
    let attempts = 0;
    let frame = 0;
    const jump = () => {
      const editor = reveal.part === undefined ? panelEditor(panelId) : panelEditorOf(panelId, reveal.part);
      if (editor === null) {
        if ((attempts += 1) < 30) frame = requestAnimationFrame(jump);
        return;
      }
      if (reveal.line !== undefined) {
        if (!reveal.focus && reveal.part !== undefined) showPanelPart(panelId, reveal.part);
        const line = reveal.line;
        const column = reveal.column ?? 1;
        const end = { line: reveal.endLine ?? line, column: reveal.endColumn ?? column };
        editor.setSelection({
          startLineNumber: line,
          startColumn: column,
          endLineNumber: end.line,
          endColumn: end.column,
        });
        editor.revealLineInCenterIfOutsideViewport(line);
      }
      if (reveal.focus && focusIsFree(panelId)) editor.focus();
    };
    frame = requestAnimationFrame(jump);
    return () => cancelAnimationFrame(frame);
  }, [panelId, reveal]);
}

/** Whoever has gone on to another panel while the editor was loading keeps the focus there. */
export function focusIsFree(panelId: string): boolean {
  const active = document.activeElement;
  if (active === null || active === document.body) return true;
  return active.closest<HTMLElement>('[data-panel-id]')?.dataset.panelId === panelId;
}
