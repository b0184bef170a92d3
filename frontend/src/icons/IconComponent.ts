import type { ComponentType, SVGProps } from 'react';

/** Lucide icons and our own object icons alike. */
export type IconComponent = ComponentType<SVGProps<SVGSVGElement> & { size?: number | string }>;
