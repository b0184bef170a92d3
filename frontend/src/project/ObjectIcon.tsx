import { createElement, type SVGProps } from 'react';
import { objectIcon } from './kinds';

interface ObjectIconProps extends SVGProps<SVGSVGElement> {
  kind: string;
  subkind?: string | null;
  name?: string;
  size?: number | string;
}

/** The icon of an object as a component. */
export function ObjectIcon({ kind, subkind, name, ...rest }: ObjectIconProps) {
  return createElement(objectIcon(kind, subkind, name), rest);
}
