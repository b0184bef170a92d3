/** Bars below the tool bar that other rooms bring: each is drawn always, and shows nothing while it has nothing to say. */
import type { ComponentType } from 'react';

const bars: ComponentType[] = [];

export function registerBar(bar: ComponentType): void {
  bars.push(bar);
}

export function allBars(): readonly ComponentType[] {
  return bars;
}
