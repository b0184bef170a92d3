/**
 * The command registry: everything a menu, a tool bar button, a key or the palette can do is a command.
 *
 * Register in the function of your room's `register.ts`, which `app/rooms.ts` calls:
 *
 *     registerCommand({
 *       id: 'online.writeValues',
 *       title: 'online.writeValues',            // i18n key
 *       icon: PencilLine,                        // lucide icon, optional
 *       keys: ['Ctrl+F7'],
 *       menu: { menu: 'online', group: '3_values', order: 1 },
 *       enabled: (context) => context.online ? true : 'reason.notLoggedIn',   // or the key of a text that says why not
 *       run: () => writePrepared(),
 *     });
 *
 * Commands that mean something else in every view (undo, copy, find, save ...) are registered once by the workbench with
 * `delegated: true`; a view offers its own act for them while it has the focus:
 *
 *     useHandlers(panelId, { 'edit.undo': { run: undo, enabled: canUndo ? true : 'reason.nothingToUndo' } });
 *
 * `enabled` and `visible` are pure functions of `CommandContext`; call `contextChanged()` when something they read
 * outside of the context has changed.
 */
import { create } from 'zustand';
import type { TextKey, TextValues } from '@/i18n';
import type { CommandContext } from './context';
import type { IconComponent } from '@/icons/IconComponent';

export type MenuId = 'file' | 'edit' | 'view' | 'project' | 'build' | 'online' | 'debug' | 'tools' | 'window' | 'help';

/** Why a command cannot run now: the key of a text, or the key with values. */
export type Reason = TextKey | { key: TextKey; values: TextValues };
export type Enablement = true | Reason;

export interface MenuPlace {
  menu: MenuId;
  /** Groups are divided by lines and sorted by name: `1_open`, `2_save` ... */
  group: string;
  order?: number;
  /** Text key of a submenu that holds the entry. */
  submenu?: TextKey;
}

export interface ToolbarPlace {
  group: string;
  order?: number;
  /** Shows the title beside the icon. */
  label?: boolean;
}

export interface Command {
  id: string;
  title: TextKey;
  titleValues?: TextValues;
  icon?: IconComponent;
  /** `Ctrl+Shift+P`, `Alt+F8`, `F5`; the first one is shown in menus. */
  keys?: readonly string[];
  /** Keys act only while the focus is inside a view of this kind; without it they act everywhere. */
  scope?: 'tree' | 'editor' | 'text';
  menu?: MenuPlace | readonly MenuPlace[];
  toolbar?: ToolbarPlace;
  /** Left out of the palette: entries that make no sense without the view they belong to. */
  hidden?: boolean;
  /** The act is offered by the focused view; see `useHandlers`. */
  delegated?: boolean;
  /** Keys pressed out of habit (Ctrl+S): where it is not possible now, nothing is said. */
  quiet?: boolean;
  /** Its keys mean something else (Shift+F10: the context menu) where it is not possible now. */
  yieldsKeys?: boolean;
  /** A check mark in menus, a pressed look in the tool bar. */
  checked?: (context: CommandContext) => boolean;
  visible?: (context: CommandContext) => boolean;
  enabled?: (context: CommandContext) => Enablement;
  run?: (context: CommandContext, argument?: unknown) => void | Promise<void>;
}

export interface Handler {
  run: (argument?: unknown) => void | Promise<void>;
  enabled?: Enablement;
}
export type Handlers = Readonly<Record<string, Handler>>;

interface RegistryState {
  commands: ReadonlyMap<string, Command>;
  /** Acts of the views, by dock panel id. */
  handlers: ReadonlyMap<string, Handlers>;
  /** Grows with `contextChanged`, so that menus and buttons look again. */
  version: number;
}

export const useRegistry = create<RegistryState>(() => ({ commands: new Map(), handlers: new Map(), version: 0 }));

/** The commands as they were registered; those of the registry have the keys of the user. */
const declared = new Map<string, Command>();
let keysOf = (command: Command): readonly string[] | undefined => command.keys;

export function registerCommand(command: Command): () => void {
  declared.set(command.id, command);
  useRegistry.setState((state) => ({ commands: new Map(state.commands).set(command.id, withKeys(command)) }));
  return () => {
    if (declared.get(command.id) !== command) return;
    declared.delete(command.id);
    useRegistry.setState((state) => {
      const commands = new Map(state.commands);
      commands.delete(command.id);
      return { commands };
    });
  };
}

/** Commands have the keys that `keys` says, those that are registered later, too. */
export function setKeysOf(keys: (command: Command) => readonly string[] | undefined): void {
  keysOf = keys;
  useRegistry.setState({ commands: new Map([...declared].map(([id, command]) => [id, withKeys(command)])) });
}

function withKeys(command: Command): Command {
  const keys = keysOf(command);
  return keys === command.keys ? command : { ...command, keys };
}

export function registerCommands(commands: readonly Command[]): () => void {
  const disposers = commands.map(registerCommand);
  return () => disposers.forEach((dispose) => dispose());
}

/** Commands that stand below each other in one group of a menu, in this order. */
export function menuGroup(menu: MenuId, group: string, ...commands: readonly Omit<Command, 'menu'>[]): Command[] {
  return commands.map((command, order) => ({ ...command, menu: { menu, group, order } }));
}

/** Sets or, with null, takes away the acts of one view. */
export function setHandlers(panelId: string, handlers: Handlers | null): void {
  useRegistry.setState((state) => {
    const all = new Map(state.handlers);
    if (handlers) all.set(panelId, handlers);
    else all.delete(panelId);
    return { handlers: all };
  });
}

/** Something that `enabled` or `checked` functions read has changed. */
export function contextChanged(): void {
  useRegistry.setState((state) => ({ version: state.version + 1 }));
}

export function findCommand(id: string): Command | undefined {
  return useRegistry.getState().commands.get(id);
}

/** Whether the command may run, and if not, why. Pure: the tests and the menus use it alike. */
export function enablementOf(
  command: Command,
  context: CommandContext,
  handlers: ReadonlyMap<string, Handlers>,
): Enablement {
  if (command.enabled) {
    const own = command.enabled(context);
    if (own !== true) return own;
  }
  if (command.delegated) {
    const handler = activeHandler(command.id, context, handlers);
    if (!handler) return command.run ? true : 'reason.notHere';
    return handler.enabled ?? true;
  }
  return true;
}

/** The focused view's act for a command; when the focus is in no such view, the active editor's. */
export function activeHandler(
  id: string,
  context: CommandContext,
  handlers: ReadonlyMap<string, Handlers>,
): Handler | undefined {
  for (const panelId of [context.focusedPanel, context.activeEditor?.panelId]) {
    const handler = panelId ? handlers.get(panelId)?.[id] : undefined;
    if (handler) return handler;
  }
  return undefined;
}
