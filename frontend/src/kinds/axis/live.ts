/** Live values of an axis and of its panel. */
import { formatShort } from '@/online/format';
import { useLiveItem, useLiveValue } from '@/online/useLive';

export const axisPath = (name: string) => `IoConfig_Globals.${name}`;
export const panelPath = (name: string) => `IoConfig_AxisPanels.${name}`;

/** A value as text, null before the first one. */
export function useShown(runtimeId: string, expression: string): string | null {
  const live = useLiveValue(runtimeId, expression);
  return live === null || live.value === null ? null : formatShort(live.value, live.item);
}

/** Whether the application that runs has the variable; true as long as nobody has said otherwise. */
export function useExists(runtimeId: string, expression: string): boolean {
  return !useLiveItem(runtimeId, expression)?.error;
}
