/** Keys of commands act while the page inside a frame has the keyboard, which the page around it does not hear. */

/** Function keys, and those with Ctrl or Alt, go to the frame's own page as if they were pressed on the frame. */
export function passKeysOn(view: Window, frame: HTMLElement): void {
  view.addEventListener('keydown', (event) => {
    if (!event.ctrlKey && !event.altKey && !event.metaKey && !/^F\d+$/.test(event.key)) return;
    const { key, code, ctrlKey, altKey, shiftKey, metaKey } = event;
    const same = { key, code, ctrlKey, altKey, shiftKey, metaKey, bubbles: true, cancelable: true };
    if (!frame.dispatchEvent(new KeyboardEvent('keydown', same))) event.preventDefault();
  });
}
