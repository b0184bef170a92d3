// @vitest-environment happy-dom
import { afterEach, describe, expect, it } from 'vitest';
import { closePalette, openPalette, usePalette } from './state';

const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

/** A field of the workbench that has the focus, and the palette's own field. */
function fields() {
  const [editor, query] = [document.createElement('textarea'), document.createElement('input')];
  document.body.append(editor, query);
  editor.focus();
  return { editor, query };
}

afterEach(() => document.body.replaceChildren());

describe('the palette', () => {
  it('gives the focus back, then runs what was chosen', async () => {
    const { editor, query } = fields();
    openPalette('commands');
    query.focus();
    let focused: Element | null = null;
    closePalette(() => {
      focused = document.activeElement;
    });
    query.remove();
    await frame();
    expect(focused).toBe(editor);
    expect(usePalette.getState().mode).toBeNull();
  });

  it('remembers the first place when it changes between commands and objects', async () => {
    const { editor, query } = fields();
    openPalette('objects');
    query.focus();
    openPalette('commands');
    closePalette();
    query.remove();
    await frame();
    expect(document.activeElement).toBe(editor);
  });
});
