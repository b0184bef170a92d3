/** What an editor of an object gets. */
import type { Place } from './place';

export interface Reveal extends Omit<Place, 'objectId'> {
  /** Different for every jump, so that jumping twice to one place works. */
  serial: number;
  /** Also give the editor the keyboard focus. */
  focus: boolean;
}

export interface EditorProps {
  /** Id of the dock panel: key for `setDirty`, `setCursor` and `useHandlers`. */
  panelId: string;
  projectId: string;
  objectId: string;
  /** Online: the instance shown, `PLC_PRG.fbFiller1`; null shows the implementation without values of an instance. */
  instance: string | null;
  reveal: Reveal | null;
  /** False while another tab of the group covers the editor. */
  visible: boolean;
}
