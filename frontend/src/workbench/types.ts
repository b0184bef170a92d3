import type { ComponentType, SVGProps } from 'react';

/** Lucide icons and our own object icons alike. */
export type IconComponent = ComponentType<SVGProps<SVGSVGElement> & { size?: number | string }>;

/** Where in an object something is; lines and columns start at 1. */
export interface Place {
  objectId: string;
  part?: 'declaration' | 'implementation';
  line?: number;
  column?: number;
  endLine?: number;
  endColumn?: number;
}
