/**
 * The messages of the compiler: those of the last build, and those the editors find while typing.
 *
 * Editors publish with `publishDiagnostics(objectId, diagnostics)` (an empty list takes them away); the build replaces
 * the messages of its application. An object that has been checked by its editor after the build shows the newer ones.
 */
import { create } from 'zustand';
import type { BuildReport, Diagnostic, Severity } from '@/api/types';
import { displayPath, displayPlace } from '@/project/objectName';

export interface BuildResult {
  applicationId: string;
  applicationName: string;
  report: BuildReport;
  /** Milliseconds since 1970. */
  at: number;
  /** Asks the server for the same once more: its messages are in the language of the request. */
  again?: () => Promise<BuildReport>;
}

interface MessagesState {
  build: BuildResult | null;
  /** What editors found, by object, since the last build. */
  live: ReadonlyMap<string, readonly Diagnostic[]>;
  /** The message last gone to, by F4 or in the table. */
  current: Diagnostic | null;
}

export const useMessages = create<MessagesState>(() => ({ build: null, live: new Map(), current: null }));

export function setCurrent(current: Diagnostic | null): void {
  useMessages.setState({ current });
}

export function buildFinished(build: BuildResult): void {
  useMessages.setState({ build, live: new Map(), current: null });
}

export function publishDiagnostics(objectId: string, diagnostics: readonly Diagnostic[]): void {
  const live = new Map(useMessages.getState().live);
  live.set(objectId, diagnostics);
  useMessages.setState({ live });
}

/** Takes the messages away; that the application was built stays known. */
export function clearMessages(): void {
  const { build } = useMessages.getState();
  const cleared = build && { ...build, report: { ...build.report, diagnostics: [] } };
  useMessages.setState({ build: cleared, live: new Map(), current: null });
}

/** The user has switched the language: messages come in the new one, those of open texts from their editors. */
export async function translateMessages(): Promise<void> {
  const { build } = useMessages.getState();
  useMessages.setState({ live: new Map(), current: null });
  if (!build?.again || build.report.diagnostics.length === 0) return;
  const { diagnostics } = await build.again();
  if (useMessages.getState().build !== build) return;
  useMessages.setState({ build: { ...build, report: { ...build.report, diagnostics } } });
}

/** Takes away the messages of a code that is not reported any more; errors stay. */
export function forgetCode(code: string): void {
  const { build, live } = useMessages.getState();
  const stays = (one: Diagnostic) => one.code !== code || one.severity === 'error';
  const left = build && {
    ...build,
    report: { ...build.report, diagnostics: build.report.diagnostics.filter(stays) },
  };
  useMessages.setState({
    build: left,
    live: new Map([...live].map(([id, found]) => [id, found.filter(stays)])),
    current: null,
  });
}

/** Another project is opened: nothing of it has been built. */
export function forgetBuild(): void {
  useMessages.setState({ build: null, live: new Map(), current: null });
}

/** A build failed, and the editors have found since that its errors are gone: what it said holds no more. Pure. */
export function isMended(build: BuildResult | null, live: ReadonlyMap<string, readonly Diagnostic[]>): boolean {
  return build !== null && !build.report.ok && countOf(presentMessages(build, live)).error === 0;
}

/** All messages that hold now. Pure. */
export function presentMessages(
  build: BuildResult | null,
  live: ReadonlyMap<string, readonly Diagnostic[]>,
): Diagnostic[] {
  const fromBuild = (build?.report.diagnostics ?? []).filter((one) => !one.object_id || !live.has(one.object_id));
  return [...fromBuild, ...[...live.values()].flat()];
}

/** The code of `{text 'x'}` in a program: a line that leads nowhere (LPRG-10). */
const TEXT = 'W1212';

/** Whether there is a place of the project to go to. Pure. */
export function hasPlace(message: Diagnostic): boolean {
  return message.object_id !== null && message.code !== TEXT;
}

export function countOf(messages: readonly Diagnostic[]): Record<Severity, number> {
  const count = { error: 0, warning: 0, info: 0 };
  for (const message of messages) count[message.severity]++;
  return count;
}

/** Number of bytes as people read it: `412 B`, `38.4 KB`, `2.1 MB`. */
export function bytesText(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  const [value, unit] = bytes < 1_000_000 ? [bytes / 1000, 'KB'] : [bytes / 1_000_000, 'MB'];
  return `${value.toFixed(value < 100 ? 1 : 0)} ${unit}`;
}

/** `Device/PLC Logic/App/FB_Motor/Start` as the table shows it: `Start` and, quieter, `Device: PLC Logic: App: FB_Motor`. */
export function pathParts(path: string): { name: string; place: string } {
  return { name: displayPath(path.slice(path.lastIndexOf('/') + 1)), place: displayPlace(path, ': ') };
}
