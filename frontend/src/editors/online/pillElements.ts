/**
 * The elements in which Monaco has drawn the pills of one editor.
 *
 * A changed decoration has Monaco make its whole line anew and measure it. A value that is as long as the one before
 * needs neither: its text and look are written into the element. Where Monaco draws a line again, with the text that
 * its decoration was made with, the latest ones are put in before the page is painted.
 */

interface Written {
  text: string;
  classes: readonly string[];
}

/** Classes by which a pill is known again; one a decoration. */
const NAME = /^pill-value-\d+$/;
let last = 0;

export function newPillName(): string {
  last += 1;
  return `pill-value-${String(last)}`;
}

export class PillElements {
  private readonly written = new Map<string, Written>();
  /** Pills on screen; null where Monaco has cut one into pieces, at the end of a wrapped line. */
  private shown: ReadonlyMap<string, HTMLElement | null> | null = null;
  private readonly observer: MutationObserver;

  /** `pill` is the class of all pills, `looks` are those that a pill has by turns. */
  constructor(
    private readonly root: HTMLElement,
    private readonly pill: string,
    private readonly looks: ReadonlySet<string>,
  ) {
    this.observer = new MutationObserver(() => this.drawnAgain());
    this.observer.observe(root, { childList: true, subtree: true });
  }

  /** What the decoration of a pill has been made with. */
  made(name: string, text: string, classes: readonly string[]): void {
    this.written.set(name, { text, classes });
  }

  /** Shows another value; false when it does not fit into what Monaco has drawn. */
  write(name: string, text: string, classes: readonly string[]): boolean {
    this.shown ??= this.find();
    const element = this.shown.get(name);
    if (element !== undefined && !this.put(element, text, classes)) return false;
    this.written.set(name, { text, classes });
    return true;
  }

  forget(name: string): void {
    this.written.delete(name);
  }

  dispose(): void {
    this.observer.disconnect();
  }

  private drawnAgain(): void {
    this.shown = this.find();
    for (const [name, element] of this.shown) {
      const written = this.written.get(name);
      if (written !== undefined) this.put(element, written.text, written.classes);
    }
  }

  private find(): ReadonlyMap<string, HTMLElement | null> {
    const found = new Map<string, HTMLElement | null>();
    for (const element of this.root.getElementsByClassName(this.pill)) {
      const name = [...element.classList].find((each) => NAME.test(each));
      if (name !== undefined) found.set(name, found.has(name) ? null : (element as HTMLElement));
    }
    return found;
  }

  private put(element: HTMLElement | null, text: string, classes: readonly string[]): boolean {
    const node = element?.firstChild;
    if (element === null || node?.nodeType !== Node.TEXT_NODE || element.childNodes.length !== 1) return false;
    const shown = node as Text;
    if (shown.length !== text.length) return false;
    if (shown.data !== text) shown.data = text;
    for (const look of this.looks) {
      const wanted = classes.includes(look);
      if (element.classList.contains(look) !== wanted) element.classList.toggle(look, wanted);
    }
    return true;
  }
}
