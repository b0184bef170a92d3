/**
 * Icons of the object kinds: 16 px, strokes of 1.5 px, round ends, one colour per family (tokens `--kind-*`).
 * Shapes: programs and blocks are boxes as they are drawn in FBD; data types are rows; variables a globe; tasks a clock.
 */
import type { ReactNode, SVGProps } from 'react';
import type { IconComponent } from './IconComponent';

type IconProps = SVGProps<SVGSVGElement> & { size?: number | string };

export function icon(color: string, shape: ReactNode): IconComponent {
  return function ObjectKindIcon({ size = 16, ...rest }: IconProps) {
    return (
      <svg
        width={size}
        height={size}
        viewBox="0 0 16 16"
        fill="none"
        stroke={`var(--kind-${color})`}
        strokeWidth={1.5}
        strokeLinecap="round"
        strokeLinejoin="round"
        aria-hidden
        {...rest}
      >
        {shape}
      </svg>
    );
  };
}

/** The frame of programs and of rows of data. */
export const BOX = <rect x="2.25" y="2.25" width="11.5" height="11.5" rx="2" />;

/** An object of a kind that is not known here: a page. */
export const NeutralIcon = icon(
  'member',
  <>
    <path d="M3.25 1.9h5.9l3.6 3.6v8.6h-9.5z" />
    <path d="M9 2v3.75h3.75" />
  </>,
);
