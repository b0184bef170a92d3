/** Keys as other systems have them. What a preset does not name has the keys it was declared with, those of CODESYS. */

export const PRESETS = ['tappet', 'twincat', 'vscode'] as const;
export type Preset = (typeof PRESETS)[number];

/** Keys by command; an empty list takes them away. */
export type KeyTable = Readonly<Record<string, readonly string[]>>;

export const PRESET_KEYS: Readonly<Record<Preset, KeyTable>> = {
  tappet: {},
  twincat: {
    'build.build': ['Ctrl+Shift+B'],
    'build.rebuild': ['Ctrl+Alt+F7'],
    'debug.stop': ['Shift+F5'],
    'st.peekReferences': ['Shift+F12', 'Ctrl+Shift+F12'],
    'build.nextMessage': ['F8'],
    'build.previousMessage': ['Shift+F8'],
  },
  vscode: {
    'build.build': ['Ctrl+Shift+B'],
    'build.nextMessage': ['F8'],
    'build.previousMessage': ['Shift+F8'],
    'debug.stop': ['Shift+F5'],
    'st.renameSymbol': ['F2'],
    'st.inputAssistant': ['Ctrl+I'],
    'view.messages': ['Ctrl+Shift+M'],
    // As the extension Bookmarks has them, whose Ctrl+Alt+K is that of the keyboard shortcuts here.
    'bookmarks.next': ['Ctrl+Alt+L'],
    'bookmarks.previous': ['Ctrl+Alt+J'],
  },
};
