/** Views of bodies by language, found by their place: `editors/<language>/body.ts`. */
import type { LanguageBody } from '@/text/languages';

const BODIES = Object.values(import.meta.glob<LanguageBody>('../*/body.ts', { eager: true, import: 'default' }));

/** The language that a body has where nothing is said, and that shows a text of any other. */
const TEXT_BODY = 'ST';

export function bodyOf(language: string): LanguageBody {
  const of = (name: string) => BODIES.find((body) => body.language === name);
  return of(language) ?? of(TEXT_BODY)!;
}
