/** The appearance that new records and variables begin with (TRC-13), kept in this browser. */
import { USUAL_APPEARANCE, type Appearance } from './configuration';

const KEY = 'tappet.trace.appearance';

export function usualAppearance(): Appearance {
  try {
    const kept = JSON.parse(localStorage.getItem(KEY) ?? 'null') as Appearance | null;
    return kept === null
      ? USUAL_APPEARANCE
      : {
          ...USUAL_APPEARANCE,
          ...kept,
          x: { ...USUAL_APPEARANCE.x, ...kept.x },
          y: { ...USUAL_APPEARANCE.y, ...kept.y },
        };
  } catch {
    return USUAL_APPEARANCE;
  }
}

export function storeUsualAppearance(appearance: Appearance): void {
  localStorage.setItem(KEY, JSON.stringify(appearance));
}
