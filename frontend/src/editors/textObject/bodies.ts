/** Views of bodies by language, found by their place: `editors/<language>/body.ts`, or `.tsx`. */
import { registerBody, type LanguageBody } from '@/text/bodies';

const BODIES = import.meta.glob<LanguageBody>('../*/body.{ts,tsx}', { eager: true, import: 'default' });

/** Makes bodies known and answers them. */
export function registerBodies(found: Readonly<Record<string, LanguageBody>> = BODIES) {
  const bodies = Object.values(found);
  bodies.forEach(registerBody);
  return bodies;
}
