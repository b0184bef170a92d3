/** The page setup of a project: what may be entered, and what a page looks like with it. Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey, TextValues } from '@/i18n';

export type PageSetup = Schemas['PageSetupData'];
export type Paper = PageSetup['paper'];
export type Side = keyof PageSetup['margins'];
export type Part = keyof PageSetup['header'];

export const SIDES = ['top', 'bottom', 'left', 'right'] as const satisfies readonly Side[];
export const PARTS = ['left', 'centre', 'right'] as const satisfies readonly Part[];
export const EDGES = ['header', 'footer'] as const;

/** Width and height of the upright sheet in mm, as `tappet.project.papers` has them. */
const SHEETS: Record<Paper, readonly [number, number]> = {
  a3: [297, 420],
  a4: [210, 297],
  a5: [148, 210],
  'us-letter': [215.9, 279.4],
  'us-legal': [215.9, 355.6],
  'us-tabloid': [279.4, 431.8],
};
export const PAPERS = Object.keys(SHEETS) as Paper[];

export const PLACEHOLDERS = [
  'project',
  'object',
  'path',
  'author',
  'company',
  'revision',
  'date',
  'time',
  'page',
  'pages',
  'page_of_pages',
] as const;
export type Placeholder = (typeof PLACEHOLDERS)[number];

const LEAST_MARGIN_MM = 5;
const MOST_MARGIN_MM = 100;
const LEAST_TEXT_MM = 60;
const MOST_LOGO_BYTES = 256 * 1024;
export const MOST_LOGO_PIXELS = 4000;

/** What holds in a project without a page setup: the defaults of the server. */
export const USUAL: PageSetup = {
  paper: 'a4',
  orientation: 'portrait',
  margins: { top: 22, right: 17, bottom: 20, left: 17 },
  title_page: true,
  contents: true,
  variables: true,
  cross_references: false,
  author: '',
  company: '',
  logo: null,
  logo_on_title_page: true,
  logo_in_header: 'none',
  header: { left: '{project}', centre: '', right: '' },
  footer: { left: '', centre: '', right: '{page_of_pages}' },
};

/** Width and height of the sheet in mm, as it is oriented. */
export function sheetOf({ paper, orientation }: Pick<PageSetup, 'paper' | 'orientation'>): readonly [number, number] {
  const [width, height] = SHEETS[paper];
  return orientation === 'portrait' ? [width, height] : [height, width];
}

export interface Fault {
  text: TextKey;
  values?: TextValues;
}

/** What is wrong with a margin, alone or with the one at the other side; null: nothing. */
export function marginFault(setup: PageSetup, side: Side): Fault | null {
  const { margins } = setup;
  const range = { least: LEAST_MARGIN_MM, most: MOST_MARGIN_MM };
  if (!(margins[side] >= LEAST_MARGIN_MM && margins[side] <= MOST_MARGIN_MM))
    return { text: 'pageSetup.marginRange', values: range };
  const across = side === 'left' || side === 'right';
  const whole = sheetOf(setup)[across ? 0 : 1];
  const taken = across ? margins.left + margins.right : margins.top + margins.bottom;
  if (!(whole - taken < LEAST_TEXT_MM)) return null;
  return { text: 'pageSetup.marginsTooWide', values: { most: Number((whole - LEAST_TEXT_MM).toFixed(1)) } };
}

type Piece = { placeholder: Placeholder } | { text: string };

/** The parts of a text at the head or foot; the text itself where it cannot be read. `{{` is a brace. */
function piecesOf(text: string): Piece[] | string {
  const found: Piece[] = [];
  for (const match of text.matchAll(/\{\{|\{([^{}]*)\}|(\{)|[^{]+/g)) {
    const [whole, name, open] = match;
    if (open !== undefined) return text.slice(match.index);
    if (name === undefined) found.push({ text: whole === '{{' ? '{' : whole });
    else if ((PLACEHOLDERS as readonly string[]).includes(name)) found.push({ placeholder: name as Placeholder });
    else return whole;
  }
  return found;
}

/** What is wrong with a text at the head or foot; null: nothing. */
export function runningFault(text: string): Fault | null {
  const pieces = piecesOf(text);
  return typeof pieces === 'string' ? { text: 'pageSetup.noPlaceholder', values: { text: pieces } } : null;
}

/** A text at the head or foot as a page shows it. */
export function filled(text: string, values: Record<Placeholder, string>): string {
  const pieces = piecesOf(text);
  if (typeof pieces === 'string') return text;
  return pieces.map((piece) => ('text' in piece ? piece.text : values[piece.placeholder])).join('');
}

/** Whether the server would take the data. */
export function canStore(setup: PageSetup): boolean {
  return (
    SIDES.every((side) => marginFault(setup, side) === null) &&
    EDGES.every((edge) => PARTS.every((part) => runningFault(setup[edge][part]) === null))
  );
}

export interface Cell {
  part: Part;
  text: string;
  /** The logo stands beside the text. */
  logo: boolean;
}

/** What stands beside each other at the head or foot; sides have all the room where there is no centre. */
export function cellsOf(texts: PageSetup['header'], logoAt: PageSetup['logo_in_header']): Cell[] {
  const cells = PARTS.map((part) => ({ part, text: texts[part], logo: part === logoAt }));
  const shown = cells.filter(({ text, logo }) => text !== '' || logo);
  return texts.centre === '' ? shown : cells;
}

/** The most room for the logo on the title page, in mm; as `tappet.documentation.document` has it. */
export const TITLE_LOGO_BOX = [80, 40] as const;

/** The same for the head of the pages. */
export function headerLogoBox(topMargin: number): readonly [number, number] {
  return [40, Math.min(10, topMargin * 0.6)];
}

/** Width and height of a picture that fills a box as far as its shape allows. */
export function fitted(
  { width, height }: { width: number; height: number },
  [most, high]: readonly [number, number],
): [number, number] {
  const scale = Math.min(most / width, high / height);
  return [width * scale, height * scale];
}

const SIGNATURES = [
  { type: 'image/png', begin: [0x89, 0x50, 0x4e, 0x47] },
  { type: 'image/jpeg', begin: [0xff, 0xd8, 0xff] },
] as const;

/** The media type by the first bytes of a file; null: neither PNG nor JPEG. */
function typeOf(bytes: Uint8Array): string | null {
  return SIGNATURES.find(({ begin }) => begin.every((byte, at) => bytes[at] === byte))?.type ?? null;
}

/** A picture as the data have it, or what is wrong with the file. The server decodes it before it takes it. */
export function logoFrom(bytes: Uint8Array): { logo: string } | { fault: Fault } {
  if (bytes.length > MOST_LOGO_BYTES) return { fault: { text: 'pageSetup.logoTooLarge' } };
  if (typeOf(bytes) === null) return { fault: { text: 'pageSetup.logoFormat' } };
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return { logo: btoa(text) };
}

/** The address of the picture for an element that shows it. */
export function logoAddress(logo: string): string {
  return `data:${logo.startsWith('/9j/') ? 'image/jpeg' : 'image/png'};base64,${logo}`;
}
