/** Selected variables are dragged out of a text editor, to watch lists and traces. */
import type { CodeEditor } from '@/text/CodePane';
import { dragOut } from '@/workbench/expressionDrag';

/**
 * The button pressed within a selection may begin a drag. An editor that can be changed moves its text meanwhile, as long
 * as the pointer is within it; in one that cannot, the selection is kept until the button is let go.
 */
export function dragsVariables(editor: CodeEditor, expressions: () => readonly string[]): void {
  const home = editor.getDomNode();
  home?.addEventListener(
    'mousedown',
    (event) => {
      if (event.button !== 0 || event.shiftKey || event.ctrlKey || event.altKey || event.detail > 1) return;
      const position = editor.getTargetAtClientPoint(event.clientX, event.clientY)?.position ?? null;
      const selection = editor.getSelection();
      if (position === null || selection === null || selection.isEmpty() || !selection.containsPosition(position))
        return;
      const fixed = editor.getRawOptions().readOnly === true;
      if (fixed) {
        event.stopPropagation();
        event.preventDefault();
        editor.focus();
      }
      const onLeave = () => {
        if (fixed) return;
        endOwnDrag();
        standStill(editor, scrolled);
      };
      const scrolled = { scrollTop: editor.getScrollTop(), scrollLeft: editor.getScrollLeft() };
      dragOut({
        home,
        expressions,
        onLeave,
        onStay: () => fixed && editor.setPosition(position),
      });
    },
    true,
  );
}

/** The editor's own moving of text, which would scroll while the pointer is elsewhere, is given up by any key. */
function endOwnDrag(): void {
  document.dispatchEvent(new KeyboardEvent('keydown', { key: 'F24', code: 'F24' }));
}

/** What it has begun to scroll at its edge is taken back, until the button is let go. */
function standStill(editor: CodeEditor, scrolled: { scrollTop: number; scrollLeft: number }): void {
  const back = () => editor.setScrollPosition(scrolled);
  back();
  const following = editor.onDidScrollChange(({ scrollTopChanged, scrollLeftChanged }) => {
    if (scrollTopChanged || scrollLeftChanged) back();
  });
  window.addEventListener('mouseup', () => following.dispose(), { once: true, capture: true });
}
