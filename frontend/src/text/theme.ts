/** The editor theme, taken from the design tokens of the page so that both always agree. */
import type { editor } from 'monaco-editor/editor/editor.api';

interface ThemeTarget {
  editor: { defineTheme: (name: string, data: editor.IStandaloneThemeData) => void; setTheme: (name: string) => void };
}

/** Tokens of the page as hex colours; `token('--fg')` gives `#1d2330`. */
export type TokenReader = (name: string) => string;

/** `#fff` as `#ffffff`: minified style sheets shorten colours, and Monaco does not take short ones. */
function longHex(colour: string): string {
  return /^#[0-9a-f]{3,4}$/i.test(colour) ? `#${[...colour.slice(1)].map((digit) => digit + digit).join('')}` : colour;
}

/** A colour that lets twice as much through: lines and the words in them are coloured on top of each other. */
function half(colour: string): string {
  const alpha = colour.length === 9 ? parseInt(colour.slice(7), 16) : 0xff;
  return `${colour.slice(0, 7)}${Math.round(alpha / 2)
    .toString(16)
    .padStart(2, '0')}`;
}

export function themeFrom(read: TokenReader, dark: boolean): editor.IStandaloneThemeData {
  const token = (name: string) => longHex(read(name));
  const plain = (name: string) => token(name).replace('#', '');
  const rule = (scope: string, name: string, fontStyle = ''): editor.ITokenThemeRule => ({
    token: scope,
    foreground: plain(name),
    fontStyle,
  });
  return {
    base: dark ? 'vs-dark' : 'vs',
    inherit: true,
    rules: [
      { token: '', foreground: plain('--fg'), background: plain('--bg') },
      rule('comment', '--fg-muted', 'italic'),
      rule('annotation', '--kind-folder'),
      rule('keyword', '--accent'),
      rule('keyword.operator', '--accent'),
      rule('operator', '--fg'),
      rule('delimiter', '--fg-muted'),
      rule('type', '--kind-data'),
      rule('number', '--kind-function'),
      rule('constant', '--kind-function'),
      rule('string', '--kind-variables'),
      rule('string.escape', '--kind-folder'),
      rule('string.invalid', '--error'),
      rule('function', '--kind-block'),
      rule('variable.address', '--kind-task'),
      // Semantic tokens of the language server.
      rule('namespace', '--kind-member'),
      rule('class', '--kind-data'),
      rule('struct', '--kind-data'),
      rule('enum', '--kind-data'),
      rule('interface', '--kind-data'),
      rule('enumMember', '--kind-function'),
      rule('method', '--kind-block'),
      rule('property', '--fg'),
      rule('variable', '--fg'),
      rule('parameter', '--fg'),
      rule('macro', '--kind-folder'),
    ],
    colors: {
      'editor.background': token('--bg'),
      'editor.foreground': token('--fg'),
      'editorGutter.background': token('--bg'),
      'editorLineNumber.foreground': token('--fg-muted'),
      'editorLineNumber.activeForeground': token('--fg'),
      'editor.lineHighlightBackground': token('--bg-hover'),
      'editor.lineHighlightBorder': '#00000000',
      'editor.selectionBackground': dark ? '#8f92f552' : '#5357cf38',
      'editor.inactiveSelectionBackground': token('--bg-selected-muted'),
      'editor.wordHighlightBackground': token('--bg-pressed'),
      'editor.wordHighlightStrongBackground': token('--bg-pressed'),
      'editor.findMatchBackground': token('--changed'),
      'editor.findMatchHighlightBackground': token('--changed'),
      'editorCursor.foreground': token('--fg'),
      'editorIndentGuide.background1': token('--line'),
      'editorIndentGuide.activeBackground1': token('--line-strong'),
      'editorBracketMatch.background': token('--bg-pressed'),
      'editorBracketMatch.border': token('--line-strong'),
      'editorError.foreground': token('--error'),
      'editorWarning.foreground': token('--warn'),
      'editorInfo.foreground': token('--accent'),
      'editorWidget.background': token('--bg-float'),
      'editorWidget.foreground': token('--fg'),
      'editorWidget.border': token('--line-strong'),
      'editorHoverWidget.background': token('--bg-float'),
      'editorHoverWidget.foreground': token('--fg'),
      'editorHoverWidget.border': token('--line-strong'),
      'editorSuggestWidget.background': token('--bg-float'),
      'editorSuggestWidget.border': token('--line-strong'),
      'editorSuggestWidget.foreground': token('--fg'),
      'editorSuggestWidget.selectedBackground': token('--bg-selected'),
      'editorSuggestWidget.selectedForeground': token('--fg'),
      'editorSuggestWidget.selectedIconForeground': token('--fg'),
      'editorSuggestWidget.highlightForeground': token('--accent'),
      'editorSuggestWidget.focusHighlightForeground': token('--accent'),
      'list.hoverBackground': token('--bg-hover'),
      'list.focusBackground': token('--bg-selected'),
      'list.activeSelectionBackground': token('--bg-selected'),
      'list.activeSelectionForeground': token('--fg'),
      'list.inactiveSelectionBackground': token('--bg-selected-muted'),
      'list.highlightForeground': token('--accent'),
      'input.background': token('--bg'),
      'input.foreground': token('--fg'),
      'input.border': token('--line-strong'),
      'inputOption.activeBorder': token('--accent'),
      'inputOption.activeBackground': token('--bg-selected'),
      'inputOption.activeForeground': token('--fg'),
      focusBorder: token('--focus'),
      'widget.shadow': '#00000028',
      'widget.border': token('--line-strong'),
      'menu.background': token('--bg-float'),
      'menu.foreground': token('--fg'),
      'menu.selectionBackground': token('--bg-selected'),
      'menu.selectionForeground': token('--fg'),
      'menu.separatorBackground': token('--line'),
      'menu.border': token('--line-strong'),
      'peekViewEditor.background': token('--bg'),
      'peekViewEditor.matchHighlightBackground': token('--changed'),
      'peekViewResult.background': token('--bg-raised'),
      'peekViewResult.fileForeground': token('--fg'),
      'peekViewResult.lineForeground': token('--fg-muted'),
      'peekViewResult.selectionBackground': token('--bg-selected'),
      'peekViewResult.selectionForeground': token('--fg'),
      'peekViewResult.matchHighlightBackground': token('--changed'),
      'peekViewTitle.background': token('--bg-raised'),
      'peekViewTitleLabel.foreground': token('--fg'),
      'peekViewTitleDescription.foreground': token('--fg-muted'),
      'peekView.border': token('--accent'),
      'diffEditor.insertedTextBackground': half(token('--ok-soft')),
      'diffEditor.removedTextBackground': half(token('--error-soft')),
      'diffEditor.insertedLineBackground': half(token('--ok-soft')),
      'diffEditor.removedLineBackground': half(token('--error-soft')),
      'diffEditor.border': token('--line'),
      'scrollbarSlider.background': token('--scroll'),
      'scrollbarSlider.hoverBackground': token('--scroll-hover'),
      'scrollbarSlider.activeBackground': token('--scroll-hover'),
      'scrollbar.shadow': '#00000000',
      'minimap.background': token('--bg'),
      'stickyScroll.background': token('--bg'),
      'editorStickyScroll.background': token('--bg'),
      'editorStickyScroll.border': token('--line'),
      'textLink.foreground': token('--accent'),
      'textCodeBlock.background': token('--bg-sunken'),
    },
  };
}

/** Sets the theme now and whenever the page changes its own. */
export function followTheme(monaco: ThemeTarget): void {
  const apply = () => {
    const styles = getComputedStyle(document.documentElement);
    const dark = document.documentElement.dataset.theme === 'dark';
    const name = dark ? 'tappet-dark' : 'tappet-light';
    monaco.editor.defineTheme(
      name,
      themeFrom((token) => styles.getPropertyValue(token).trim(), dark),
    );
    monaco.editor.setTheme(name);
  };
  apply();
  new MutationObserver(apply).observe(document.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
}
