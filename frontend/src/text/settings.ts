/** What the user chose for text editors and online values; kept on the server for the account. */
import { create } from 'zustand';
import { loadSetting, saveSetting } from '@/session/preferences';

export const NUMBER_FORMATS = ['dec', 'hex', 'bin', 'sci'] as const;
export type NumberFormat = (typeof NUMBER_FORMATS)[number];

/** How a text that has a table form is shown. */
export type TextView = 'text' | 'table';

export interface EditorSettings {
  /** View in which declarations open (DECL-03). */
  declarationView: TextView;
  /** View in which bodies in IL open. */
  ilView: TextView;
  /** Optional columns of the table of IL (FBD-41, IL-01). */
  ilAddress: boolean;
  ilSymbolComment: boolean;
  ilOperandComment: boolean;
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
}

const TAB_WIDTH = 4;

/** Indentation as Monaco's options of an editor or a model. */
export function indentation({ formatIndent }: EditorSettings): { tabSize: number; insertSpaces: boolean } {
  return { tabSize: formatIndent || TAB_WIDTH, insertSpaces: formatIndent > 0 };
}

const DEFAULTS: EditorSettings = {
  declarationView: 'text',
  ilView: 'table',
  ilAddress: true,
  ilSymbolComment: true,
  ilOperandComment: true,
  declarationShare: 0.4,
  numberFormat: 'dec',
  lastType: 'BOOL',
  autoDeclare: false,
  formatIndent: 4,
  formatKeywords: 'upper',
  formatOperators: true,
  formatCommas: true,
};
const KEY = 'editors';
const SAVE_AFTER_MS = 1000;

export const useEditorSettings = create<EditorSettings>(() => DEFAULTS);

let loaded: Promise<void> | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Reads the settings once; until then, and when they cannot be read, the defaults hold. */
export function loadEditorSettings(): Promise<void> {
  loaded ??= loadSetting<Partial<EditorSettings>>(KEY).then(
    (stored) => useEditorSettings.setState(sound(stored)),
    () => undefined,
  );
  return loaded;
}

/** Keeps only what has the right type: settings may come from another version. */
function sound(stored: Partial<EditorSettings> | null): Partial<EditorSettings> {
  const known = Object.entries(DEFAULTS) as [keyof EditorSettings, unknown][];
  const right = known.filter(([key, value]) => typeof stored?.[key] === typeof value);
  return Object.fromEntries(right.map(([key]) => [key, stored?.[key]]));
}

export function setEditorSettings(change: Partial<EditorSettings>): void {
  useEditorSettings.setState(change);
  clearTimeout(timer);
  timer = setTimeout(() => void saveSetting(KEY, useEditorSettings.getState()).catch(() => undefined), SAVE_AFTER_MS);
}
