import type { Example } from '@/api/types';
import type { t as text } from '@/i18n';

/** Examples whose texts exist in all languages; others say what their project file says. */
const KNOWN = [
  'axis_group',
  'bottling',
  'flying_shear',
  'gantry',
  'pick_and_place',
  'rotary_knife',
  'router',
  'winder',
] as const;

/** Title and description of an example in the language of the user. */
export function exampleText(t: typeof text, example: Example): { title: string; description: string } {
  const known = KNOWN.find((name) => name === example.name);
  if (!known) return { title: example.title, description: example.description };
  return { title: t(`example.${known}`), description: t(`example.${known}Text`) };
}
