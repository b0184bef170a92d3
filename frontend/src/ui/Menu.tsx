import { Check, ChevronRight } from 'lucide-react';
import { ContextMenu as RadixContext, DropdownMenu as RadixDropdown, Menubar } from 'radix-ui';
import { useRef, useState, type ComponentType, type ReactElement, type ReactNode } from 'react';
import type { IconComponent } from '@/icons/IconComponent';
import styles from './Menu.module.css';
import { setMenuOrigin } from './menuOrigin';
import { Tooltip } from './Tooltip';

export type MenuEntry =
  | {
      kind: 'item';
      key: string;
      text: string;
      icon?: IconComponent;
      shortcut?: string;
      checked?: boolean;
      /** Why it cannot be chosen now. */
      disabledReason?: string | null;
      danger?: boolean;
      run: () => void;
    }
  | { kind: 'sub'; key: string; text: string; icon?: IconComponent; entries: readonly MenuEntry[] }
  | { kind: 'line'; key: string };

/** The parts that Menubar, DropdownMenu and ContextMenu of Radix have in common. */
interface Parts {
  Item: ComponentType<{
    className?: string;
    'aria-disabled'?: boolean;
    onSelect?: (event: Event) => void;
    children?: ReactNode;
    role?: string;
    'aria-checked'?: boolean;
  }>;
  Sub: ComponentType<{ children?: ReactNode }>;
  SubTrigger: ComponentType<{ className?: string; children?: ReactNode }>;
  SubContent: ComponentType<{ className?: string; sideOffset?: number; alignOffset?: number; children?: ReactNode }>;
  Separator: ComponentType<{ className?: string }>;
  Portal: ComponentType<{ children?: ReactNode }>;
}

export function MenuItems({ parts, entries }: { parts: Parts; entries: readonly MenuEntry[] }) {
  return entries.map((entry) => {
    switch (entry.kind) {
      case 'line':
        return <parts.Separator key={entry.key} className={styles.line} />;
      case 'sub':
        return (
          <parts.Sub key={entry.key}>
            <parts.SubTrigger className={styles.item}>
              <Slot icon={entry.icon} />
              {entry.text}
              <span className={styles.sub}>
                <ChevronRight size={14} />
              </span>
            </parts.SubTrigger>
            <parts.Portal>
              <parts.SubContent className={styles.menu} sideOffset={2} alignOffset={-5}>
                <MenuItems parts={parts} entries={entry.entries} />
              </parts.SubContent>
            </parts.Portal>
          </parts.Sub>
        );
      default:
        return <Item key={entry.key} parts={parts} entry={entry} />;
    }
  });
}

function Item({ parts, entry }: { parts: Parts; entry: Extract<MenuEntry, { kind: 'item' }> }) {
  const disabled = Boolean(entry.disabledReason);
  const item = (
    <parts.Item
      className={`${styles.item} ${entry.danger && !disabled ? styles.danger : ''}`}
      aria-disabled={disabled || undefined}
      {...(entry.checked !== undefined && { role: 'menuitemcheckbox', 'aria-checked': entry.checked })}
      onSelect={(event) => (disabled ? event.preventDefault() : entry.run())}
    >
      <Slot icon={entry.icon} checked={entry.checked} />
      {entry.text}
      {entry.shortcut && <span className={styles.shortcut}>{entry.shortcut}</span>}
    </parts.Item>
  );
  if (!entry.disabledReason) return item;
  return (
    <Tooltip text={entry.disabledReason} side="right">
      {item}
    </Tooltip>
  );
}

function Slot({ icon: Icon, checked }: { icon?: IconComponent; checked?: boolean }) {
  return (
    <span className={styles.slot}>{checked ? <Check size={15} /> : Icon && <Icon size={16} strokeWidth={1.6} />}</span>
  );
}

/** A button that opens a menu. The entries are made when it opens. */
export function DropdownMenu({
  trigger,
  entries,
  align,
}: {
  trigger: ReactElement;
  entries: () => readonly MenuEntry[];
  align?: 'start' | 'end';
}) {
  const [shown, setShown] = useState<readonly MenuEntry[]>([]);
  return (
    <RadixDropdown.Root modal={false} onOpenChange={(open) => open && setShown(entries())}>
      <RadixDropdown.Trigger asChild>{trigger}</RadixDropdown.Trigger>
      <RadixDropdown.Portal>
        <RadixDropdown.Content className={styles.menu} sideOffset={4} align={align ?? 'start'} collisionPadding={8}>
          <MenuItems parts={RadixDropdown} entries={shown} />
        </RadixDropdown.Content>
      </RadixDropdown.Portal>
    </RadixDropdown.Root>
  );
}

interface ContextMenuProps {
  /** Made when the menu opens; it appears when they are there. */
  entries: () => readonly MenuEntry[] | Promise<readonly MenuEntry[]>;
  children: ReactElement;
}

/** The right-click menu of whatever it surrounds. */
export function ContextMenu({ entries, children }: ContextMenuProps) {
  const [shown, setShown] = useState<readonly MenuEntry[]>([]);
  const opened = useRef(0);
  const before = useRef<Element | null>(null);
  const onOpenChange = (open: boolean) => {
    opened.current += 1;
    if (!open) return;
    before.current = document.activeElement;
    const made = entries();
    if (!(made instanceof Promise)) {
      setShown(made);
      return;
    }
    const turn = opened.current;
    setShown([]);
    void made.then((found) => turn === opened.current && setShown(found));
  };
  return (
    <RadixContext.Root modal={false} onOpenChange={onOpenChange}>
      <RadixContext.Trigger asChild>{children}</RadixContext.Trigger>
      <RadixContext.Portal>
        {shown.length > 0 && (
          <RadixContext.Content
            ref={(menu) => {
              if (menu) setMenuOrigin(menu, before.current);
            }}
            className={styles.menu}
            collisionPadding={8}
          >
            <MenuItems parts={RadixContext} entries={shown} />
          </RadixContext.Content>
        )}
      </RadixContext.Portal>
    </RadixContext.Root>
  );
}

export const menubarParts = Menubar as unknown as Parts;
export const menuClass = styles.menu;
