import { useText } from '@/i18n';
import { useRegistry } from '../commands';
import { keysText } from '../keys';
import { runCommand, titleOf } from '../run';
import styles from './Watermark.module.css';

const SHOWN = ['view.quickOpen', 'view.commandPalette', 'project.addObject', 'build.build', 'online.login'];

/** What an empty editor area offers: the ways to go on, with their keys. */
export function Watermark() {
  useText();
  const commands = useRegistry((state) => state.commands);
  return (
    <div className={styles.watermark}>
      <div className={styles.list}>
        {SHOWN.map((id) => commands.get(id))
          .filter((command) => command !== undefined)
          .map((command) => (
            <button type="button" key={command.id} className={styles.line} onClick={() => void runCommand(command.id)}>
              {titleOf(command)}
              {command.keys?.[0] && <kbd className={styles.key}>{keysText(command.keys[0])}</kbd>}
            </button>
          ))}
      </div>
    </div>
  );
}
