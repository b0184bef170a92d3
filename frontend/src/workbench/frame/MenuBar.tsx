import { Search } from 'lucide-react';
import { Menubar } from 'radix-ui';
import { useMemo } from 'react';
import { useText } from '@/i18n';
import { TappetMark } from '@/icons/TappetMark';
import { useRegistry, type MenuId } from '../commands';
import { commandContext } from '../context';
import { useProject } from '@/project/openProject';
import { MENUS, runCommand, useOpenMenu } from '../run';
import { MenuItems, menubarParts, menuClass, type MenuEntry } from '@/ui/Menu';
import { Tooltip } from '@/ui/Tooltip';
import { menuEntries } from './menuEntries';
import styles from './MenuBar.module.css';
import { OtherUsers } from './OtherUsers';
import { UserMenu } from './UserMenu';

/** The title with the letter that opens it by Alt underlined; where the title lacks it (Chinese), it stands behind. */
function MenuTitle({ title, letter }: { title: string; letter: string }) {
  const at = title.toUpperCase().indexOf(letter);
  if (at < 0) return `${title}(${letter})`;
  return (
    <>
      {title.slice(0, at)}
      <u className={styles.letter}>{title.slice(at, at + 1)}</u>
      {title.slice(at + 1)}
    </>
  );
}

/** Menus at the left, the finder in the middle, people and the user at the right. */
export function MenuBar() {
  const t = useText();
  const name = useProject((state) => state.projectName);
  const open = useOpenMenu((state) => state.id);
  return (
    <header className={styles.bar}>
      <div className={styles.left}>
        <Tooltip text={t('command.closeProject')}>
          <button
            type="button"
            className={styles.mark}
            aria-label={t('command.closeProject')}
            onClick={() => void runCommand('file.closeProject')}
          >
            <TappetMark />
          </button>
        </Tooltip>
        <Menubar.Root
          className={styles.menus}
          aria-label={t('menu.label')}
          value={open}
          onValueChange={(id) => useOpenMenu.setState({ id: id as MenuId | '' })}
        >
          {MENUS.map((menu) => (
            <Menubar.Menu key={menu.id} value={menu.id}>
              <Menubar.Trigger className={styles.trigger} aria-keyshortcuts={`Alt+${menu.letter}`}>
                <MenuTitle title={t(menu.title)} letter={menu.letter} />
              </Menubar.Trigger>
              <Menubar.Portal>
                <Menubar.Content
                  className={menuClass}
                  align="start"
                  sideOffset={4}
                  alignOffset={-2}
                  collisionPadding={8}
                >
                  <OpenMenu id={menu.id} />
                </Menubar.Content>
              </Menubar.Portal>
            </Menubar.Menu>
          ))}
        </Menubar.Root>
      </div>
      <button
        type="button"
        className={styles.finder}
        onClick={() => void runCommand('view.quickOpen')}
        aria-label={`${name ?? ''} ${t('command.quickOpen')}`}
      >
        <Search size={13} aria-hidden />
        <span>{name}</span>
      </button>
      <div className={styles.right}>
        <OtherUsers />
        <UserMenu />
      </div>
    </header>
  );
}

/** The entries of a menu while it is open: made from the context at that moment. */
function OpenMenu({ id }: { id: (typeof MENUS)[number]['id'] }) {
  const commands = useRegistry((state) => state.commands);
  const entries: readonly MenuEntry[] = useMemo(
    () => menuEntries(commands.values(), id, commandContext()),
    [commands, id],
  );
  return <MenuItems parts={menubarParts} entries={entries} />;
}
