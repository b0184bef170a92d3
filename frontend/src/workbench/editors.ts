/**
 * The editor registry: which component opens an object of a kind.
 *
 * Register at module level of your room's `register.ts`; the component is loaded when the first such object opens:
 *
 *     registerEditor({
 *       id: 'st',
 *       kinds: ['pou', 'method', 'action', 'accessor', 'interface', 'dut', 'gvl'],
 *       component: lazy(() => import('./st/StEditor')),
 *     });
 *
 * The component fills its panel (height 100 %) and reads its object with `useObject(projectId, objectId)`. It tells the
 * frame about unsaved changes with `setDirty(panelId, true)`, offers `file.save`, `edit.undo` and so on through
 * `useHandlers(panelId, ...)`, and the cursor position through `setCursor(panelId, {line, column})`.
 * A jump into an already open editor arrives as a new `reveal` value; `reveal.serial` differs for each jump.
 */
import type { ComponentType, LazyExoticComponent } from 'react';
import type { ObjectKind, ObjectSummary } from '@/api/types';
import type { Place } from './types';

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

export interface EditorRegistration {
  id: string;
  kinds: readonly ObjectKind[];
  /** Narrows `kinds`: for example only POUs whose language is LD. */
  accepts?: (object: ObjectSummary) => boolean;
  component: LazyExoticComponent<ComponentType<EditorProps>> | ComponentType<EditorProps>;
}

const registrations: EditorRegistration[] = [];

/** The registration made last wins where several fit. */
export function registerEditor(registration: EditorRegistration): () => void {
  registrations.unshift(registration);
  return () => {
    const index = registrations.indexOf(registration);
    if (index >= 0) registrations.splice(index, 1);
  };
}

export function editorFor(object: ObjectSummary): EditorRegistration | undefined {
  return registrations.find((entry) => entry.kinds.includes(object.kind) && (entry.accepts?.(object) ?? true));
}
