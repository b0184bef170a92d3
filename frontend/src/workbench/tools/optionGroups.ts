/** Groups of the options dialog; rooms above the workbench register theirs. */
import type { ComponentType } from 'react';
import type { TextKey } from '@/i18n';

export interface OptionGroup {
  title: TextKey;
  order: number;
  component: ComponentType;
}

const groups: OptionGroup[] = [];

export function registerOptionGroup(group: OptionGroup): void {
  groups.push(group);
  groups.sort((a, b) => a.order - b.order);
}

export function optionGroups(): readonly OptionGroup[] {
  return groups;
}
