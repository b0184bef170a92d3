/**
 * Variables dragged to watch lists and traces.
 *
 * Tables drag their rows by the browser's own drag and drop. A text editor cannot: its selection is its own, and pressing
 * the button in it moves text. There the drag begins when the pointer leaves the editor; from then on the elements under
 * the pointer get the same drag events as from a table, so that who accepts one accepts the other.
 */
import styles from './expressionDrag.module.css';

/** The kind of what is dragged between watch lists, tables and editors. */
export const EXPRESSION_MIME = 'application/x-tappet-expression';

export function fillTransfer(data: DataTransfer, expressions: readonly string[]): void {
  data.setData(EXPRESSION_MIME, JSON.stringify(expressions));
  data.setData('text/plain', expressions.join('\n'));
  data.effectAllowed = 'copy';
}

/** Dragged variables, or the lines of a dragged text. */
export function droppedLines(data: DataTransfer): { expressions: readonly string[]; text: boolean } {
  const own = data.getData(EXPRESSION_MIME);
  if (own !== '') return { expressions: JSON.parse(own) as string[], text: false };
  const lines = data.getData('text/plain').split(/\r?\n/);
  return { expressions: lines.map((line) => line.trim()).filter((line) => line !== ''), text: true };
}

export interface DragSource {
  /** Within it the gesture means something else: selecting, moving text. */
  home: Element;
  /** Asked when the pointer leaves the home. */
  expressions: () => readonly string[] | Promise<readonly string[]>;
  onLeave?: () => void;
  /** The button was let go within the home. */
  onStay?: () => void;
}

/** Follows the pressed mouse button; outside of its home the variables are dragged. */
export function dragOut({ home, expressions, onLeave, onStay }: DragSource): void {
  let drag: Drag | null = null;
  const onMove = (event: MouseEvent) => {
    if (drag === null) {
      if (inside(home, event)) return;
      drag = new Drag();
      const begun = drag;
      void Promise.resolve(expressions()).then((found) => begun.carry(found));
      onLeave?.();
    }
    drag.over(event);
  };
  const onUp = (event: MouseEvent) => {
    if (drag === null) onStay?.();
    else drag.drop(event);
    end();
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return;
    if (drag !== null) event.stopPropagation();
    end();
  };
  const end = () => {
    drag?.end();
    window.removeEventListener('mousemove', onMove, true);
    window.removeEventListener('mouseup', onUp, true);
    window.removeEventListener('keydown', onKey, true);
    window.removeEventListener('mousedown', end, true);
  };
  window.addEventListener('mousemove', onMove, true);
  window.addEventListener('mouseup', onUp, true);
  window.addEventListener('keydown', onKey, true);
  // Where letting go was not told of, the next press ends it.
  window.addEventListener('mousedown', end, true);
}

function inside(home: Element, { clientX, clientY }: MouseEvent): boolean {
  const { left, right, top, bottom } = home.getBoundingClientRect();
  return clientX >= left && clientX < right && clientY >= top && clientY < bottom;
}

/** One gesture outside of its home: a label at the pointer, and the events for what is below it. */
class Drag {
  private readonly data = new DataTransfer();
  private readonly label = document.createElement('div');
  private target: Element | null = null;
  private empty = true;

  constructor() {
    this.label.className = styles.dragged!;
    this.label.setAttribute('aria-hidden', 'true');
    document.body.append(this.label);
    document.body.classList.add(styles.dragging!);
  }

  carry(expressions: readonly string[]): void {
    this.empty = expressions.length === 0;
    if (this.empty) return this.label.remove();
    fillTransfer(this.data, expressions);
    const more = expressions.length - 1;
    this.label.textContent = `${expressions[0] ?? ''}${more > 0 ? ` +${String(more)}` : ''}`;
  }

  /** Whether what is below the pointer would take it. */
  over(event: MouseEvent): boolean {
    const below = this.empty ? null : document.elementFromPoint(event.clientX, event.clientY);
    if (below !== this.target) {
      this.tell(this.target, 'dragleave', event, below);
      this.target = below;
      this.tell(below, 'dragenter', event);
    }
    const taken = this.tell(below, 'dragover', event);
    this.label.toggleAttribute('data-taken', taken);
    this.label.style.transform = `translate(${String(event.clientX + 12)}px, ${String(event.clientY + 12)}px)`;
    return taken;
  }

  drop(event: MouseEvent): void {
    if (this.over(event)) this.tell(this.target, 'drop', event);
    else this.tell(this.target, 'dragleave', event);
    this.target = null;
  }

  end(): void {
    if (this.target !== null) this.tell(this.target, 'dragleave', new MouseEvent('mousemove'));
    this.label.remove();
    document.body.classList.remove(styles.dragging!);
  }

  private tell(target: Element | null, type: string, { clientX, clientY }: MouseEvent, to?: Element | null): boolean {
    if (target === null) return false;
    const event = new DragEvent(type, {
      bubbles: true,
      cancelable: true,
      composed: true,
      dataTransfer: this.data,
      relatedTarget: to ?? null,
      clientX,
      clientY,
    });
    return !target.dispatchEvent(event);
  }
}
