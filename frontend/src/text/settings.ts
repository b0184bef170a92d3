/** What the user chose for text editors and online values; kept on the server for the account. */
import { settingsOf } from '@/session/settings';

export const NUMBER_FORMATS = ['dec', 'hex', 'bin', 'sci'] as const;
export type NumberFormat = (typeof NUMBER_FORMATS)[number];

/** How a text that has a table form is shown. */
export type TextView = 'text' | 'table';

export interface EditorSettings {
  /** View in which declarations open (DECL-03). */
  declarationView: TextView;
  /** Height of the declaration pane, as part of the editor. */
  declarationShare: number;
  /** Number format of inline values and online tables. */
  numberFormat: NumberFormat;
  /** Most recently used data type: default of a new row (DECL-24). */
  lastType: string;
  /** Ask to declare an unknown name when its line is finished (DECL-60). */
  autoDeclare: boolean;
  /** Columns of one level of indentation; 0 stands for a tab. */
  formatIndent: number;
  /** Case that formatting gives to keywords. */
  formatKeywords: 'upper' | 'lower' | 'keep';
  /** Formatting puts blanks around operators, and behind commas. */
  formatOperators: boolean;
  formatCommas: boolean;
  /** Tab leaves the text instead of indenting it. */
  tabMovesFocus: boolean;
}

const TAB_WIDTH = 4;

/** Indentation as Monaco's options of an editor or a model. */
export function indentation({ formatIndent }: EditorSettings): { tabSize: number; insertSpaces: boolean } {
  return { tabSize: formatIndent || TAB_WIDTH, insertSpaces: formatIndent > 0 };
}

const settings = settingsOf<EditorSettings>('editors', {
  declarationView: 'text',
  declarationShare: 0.4,
  numberFormat: 'dec',
  lastType: 'BOOL',
  autoDeclare: false,
  formatIndent: 4,
  formatKeywords: 'upper',
  formatOperators: true,
  formatCommas: true,
  tabMovesFocus: false,
});

export const useEditorSettings = settings.use;
export const loadEditorSettings = settings.load;
export const setEditorSettings = settings.change;
