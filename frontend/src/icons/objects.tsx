/**
 * Icons of the object kinds: 16 px, strokes of 1.5 px, round ends, one colour per family (tokens `--kind-*`).
 * Shapes: programs and blocks are boxes as they are drawn in FBD; data types are rows; variables a globe; tasks a clock.
 */
import { createElement, type ReactNode, type SVGProps } from 'react';
import type { ObjectKind } from '@/api/types';
import type { IconComponent } from '@/workbench/types';

type IconProps = SVGProps<SVGSVGElement> & { size?: number | string };

function icon(color: string, shape: ReactNode): IconComponent {
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

const box = <rect x="2.25" y="2.25" width="11.5" height="11.5" rx="2" />;

const Program = icon(
  'program',
  <>
    {box}
    <path d="M6.5 5.4v5.2L10.6 8z" fill="currentColor" style={{ color: 'var(--kind-program)' }} />
  </>,
);

const FunctionBlock = icon(
  'block',
  <>
    <rect x="4.25" y="2.25" width="7.5" height="11.5" rx="1.5" />
    <path d="M1.5 5.75h2.75M1.5 10.25h2.75M11.75 5.75h2.75M11.75 10.25h2.75" />
  </>,
);

const FunctionIcon = icon(
  'function',
  <>
    {box}
    <path d="M10.2 4.9c-1.5-.5-2.3.2-2.5 1.6l-.6 3.3c-.2 1.1-.8 1.6-1.8 1.4M5.9 7.4h3.7" />
  </>,
);

const Method = icon(
  'member',
  <>
    <path d="M5.5 3.25H4.25a1.5 1.5 0 0 0-1.5 1.5v6.5a1.5 1.5 0 0 0 1.5 1.5H5.5M10.5 3.25h1.25a1.5 1.5 0 0 1 1.5 1.5v6.5a1.5 1.5 0 0 1-1.5 1.5H10.5" />
    <path d="M6 8h4M8.5 6.2 10.3 8 8.5 9.8" />
  </>,
);

const Action = icon('member', <path d="M8.9 1.9 3.6 9h3.9l-.6 5.1L12.3 7H8.3z" />);

const Property = icon(
  'member',
  <>
    <path d="M2.25 5h5M11 5h2.75M2.25 11H5M8.75 11h5" />
    <circle cx="9.1" cy="5" r="1.8" />
    <circle cx="6.9" cy="11" r="1.8" />
  </>,
);

const Getter = icon('member', <path d="M3 2.75v10.5M6.25 8h7M10.5 5.2 13.3 8l-2.8 2.8" />);
const Setter = icon('member', <path d="M3 2.75v10.5M13.25 8h-7M9 5.2 6.2 8 9 10.8" />);

const Interface = icon(
  'block',
  <>
    <circle cx="11" cy="8" r="2.75" />
    <path d="M2 8h6.25M2 5.25v5.5" />
  </>,
);

const Struct = icon(
  'data',
  <>
    {box}
    <path d="M2.25 6.1h11.5M2.25 9.9h11.5M6.4 6.1v7.65" />
  </>,
);

const Enumeration = icon(
  'data',
  <>
    <path d="M6.75 4h7M6.75 8h7M6.75 12h7" />
    <path d="M2.4 4h1.2M2.4 8h1.2M2.4 12h1.2" strokeWidth={2.2} />
  </>,
);

const Union = icon(
  'data',
  <>
    <rect x="2.25" y="2.25" width="7.75" height="7.75" rx="1.5" />
    <path d="M6 12.25v.25c0 .7.55 1.25 1.25 1.25h5.25c.7 0 1.25-.55 1.25-1.25V7.25C13.75 6.55 13.2 6 12.5 6h-.25" />
  </>,
);

const Alias = icon('data', <path d="M2.25 5.75h11.5M2.25 10.25h8M11 7.5l2.75 2.75L11 13" />);

const Globals = icon(
  'variables',
  <>
    <circle cx="8" cy="8" r="5.9" />
    <path d="M2.2 8h11.6M8 2.1c2.1 1.7 2.9 3.7 2.9 5.9s-.8 4.2-2.9 5.9c-2.1-1.7-2.9-3.7-2.9-5.9S5.9 3.8 8 2.1z" />
  </>,
);

const ParameterList = icon(
  'variables',
  <>
    <path d="M2.25 4h6M11.75 4h2M2.25 8h1.5M7.25 8h6.5M2.25 12h5M10.75 12h3" />
    <path d="M10 2.25v3.5M5.5 6.25v3.5M9 10.25v3.5" />
  </>,
);

const Persistent = icon(
  'variables',
  <>
    <ellipse cx="8" cy="4" rx="5.25" ry="2" />
    <path d="M2.75 4v8c0 1.1 2.35 2 5.25 2s5.25-.9 5.25-2V4M2.75 8c0 1.1 2.35 2 5.25 2s5.25-.9 5.25-2" />
  </>,
);

const Scene = icon(
  'scene',
  <>
    <path d="M8 1.9l5.4 3v6.2L8 14.1l-5.4-3V4.9z" />
    <path d="M2.6 4.9L8 8l5.4-3.1M8 8v6.1" />
  </>,
);

const Task = icon(
  'task',
  <>
    <circle cx="8" cy="8" r="5.9" />
    <path d="M8 4.6V8l2.3 1.6" />
  </>,
);

const TaskConfiguration = icon(
  'task',
  <>
    <path d="M2.25 3.25h6M2.25 7h3.5M2.25 10.75h2.5" />
    <circle cx="10.5" cy="10" r="3.9" />
    <path d="M10.5 7.9V10l1.4.9" />
  </>,
);

const LibraryManager = icon(
  'folder',
  <>
    <path d="M2.5 2.75v10.5M5.5 2.75v10.5M2.5 13.25h3" />
    <path d="m8.2 3.6 3.9 9.7 1.9-.8-3.9-9.7z" />
  </>,
);

const Device = icon(
  'device',
  <>
    <rect x="1.75" y="3.25" width="12.5" height="9.5" rx="1.5" />
    <path d="M5.5 3.25v9.5M8 6h3.75M8 8.5h3.75" />
    <path d="M3.6 6h.05" strokeWidth={2} />
  </>,
);

const PlcLogic = icon(
  'device',
  <>
    <rect x="4.25" y="4.25" width="7.5" height="7.5" rx="1.25" />
    <path d="M6.25 1.75v2.5M9.75 1.75v2.5M6.25 11.75v2.5M9.75 11.75v2.5M1.75 6.25h2.5M1.75 9.75h2.5M11.75 6.25h2.5M11.75 9.75h2.5" />
  </>,
);

const Application = icon(
  'program',
  <>
    <path d="m8 1.75 5.5 3.1v6.3L8 14.25l-5.5-3.1v-6.3z" />
    <path d="m2.7 5 5.3 3 5.3-3M8 8v6" />
  </>,
);

const Folder = icon(
  'folder',
  <path d="M1.9 11.75v-7.5c0-.7.55-1.25 1.25-1.25h2.9l1.6 1.75h5.2c.7 0 1.25.55 1.25 1.25v5.75c0 .7-.55 1.25-1.25 1.25h-9.7c-.7 0-1.25-.55-1.25-1.25z" />,
);

const Unknown = icon(
  'member',
  <>
    <path d="M3.25 1.9h5.9l3.6 3.6v8.6h-9.5z" />
    <path d="M9 2v3.75h3.75" />
  </>,
);

const BY_KIND: Partial<Record<ObjectKind, IconComponent>> = {
  folder: Folder,
  device: Device,
  plc_logic: PlcLogic,
  application: Application,
  pou: Program,
  method: Method,
  action: Action,
  property: Property,
  interface: Interface,
  dut: Struct,
  gvl: Globals,
  persistent: Persistent,
  task_configuration: TaskConfiguration,
  task: Task,
  library_manager: LibraryManager,
  scene: Scene,
};

const BY_SUBKIND: Record<string, IconComponent> = {
  program: Program,
  function: FunctionIcon,
  function_block: FunctionBlock,
  struct: Struct,
  enum: Enumeration,
  union: Union,
  alias: Alias,
  parameter_list: ParameterList,
};

/** Icon of an object by kind, subkind and, for property accessors, name. */
export function objectIcon(kind: ObjectKind, subkind?: string | null, name?: string): IconComponent {
  if (kind === 'accessor') return name?.toUpperCase() === 'SET' ? Setter : Getter;
  return (subkind && BY_SUBKIND[subkind]) || BY_KIND[kind] || Unknown;
}

interface ObjectIconProps extends IconProps {
  kind: ObjectKind;
  subkind?: string | null;
  name?: string;
}

/** The icon of an object as a component. */
export function ObjectIcon({ kind, subkind, name, ...rest }: ObjectIconProps) {
  return createElement(objectIcon(kind, subkind, name), rest);
}

/** The product's mark: a valve tappet over its cam. */
export function TappetMark({ size = 18 }: { size?: number }) {
  return (
    <svg width={size} height={size} viewBox="0 0 32 32" aria-hidden>
      <rect width="32" height="32" rx="7" fill="var(--accent)" />
      <path d="M8 11h16M16 11v8" stroke="var(--fg-on-accent)" strokeWidth="3.2" strokeLinecap="round" fill="none" />
      <circle cx="16" cy="22.5" r="3" fill="none" stroke="var(--fg-on-accent)" strokeWidth="2.6" />
    </svg>
  );
}
