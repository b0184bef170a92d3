/** What the commands of the debugger do. */
import { api } from '@/api/client';
import type { Breakpoint, BreakpointOrder, FrameVariable, Schemas, StackFrame } from '@/api/types';
import { t } from '@/i18n';
import { useProject } from '@/project/openProject';
import { notify } from '@/ui/notices';
import { jumpToFrame } from '../online/exception';
import { debugStateRead, stackRead, useDebugger, variablesRead } from './state';

type ControlOrder = Schemas['ControlDebugger'];
type Spot = Schemas['Spot'];
export type DebugSettings = Schemas['Settings'];

const at = (runtimeId: string) => ({ params: { path: { runtime_id: runtimeId } } });

/** Reads the state of the debugger again. */
export async function refreshDebugger(runtimeId: string): Promise<void> {
  debugStateRead(runtimeId, await api.get('/api/v1/runtimes/{runtime_id}/debug', at(runtimeId)));
}

/** The first breakpoint compiles the instrumented code, which takes its time: the status bar says so. */
export async function compiled<Answer>(runtimeId: string, act: () => Promise<Answer>): Promise<Answer> {
  if (useDebugger.getState().runtimes[runtimeId]?.state.available === true) return act();
  useProject.setState({ busy: { text: t('debugger.compiling'), cancel: () => undefined } });
  try {
    return await act();
  } finally {
    useProject.setState({ busy: null });
  }
}

export async function addBreakpoint(runtimeId: string, breakpoint: BreakpointOrder): Promise<Breakpoint> {
  const made = await compiled(runtimeId, () =>
    api.post('/api/v1/runtimes/{runtime_id}/debug/breakpoints', { ...at(runtimeId), body: { breakpoint } }),
  );
  await refreshDebugger(runtimeId);
  if (!made.verified && made.reason !== null)
    notify({ tone: 'warn', title: t('debugger.unverified'), text: made.reason });
  return made;
}

export async function changeBreakpoint(runtimeId: string, id: number, breakpoint: BreakpointOrder): Promise<void> {
  const params = { path: { runtime_id: runtimeId, id: String(id) } };
  await compiled(runtimeId, () =>
    api.put('/api/v1/runtimes/{runtime_id}/debug/breakpoints/{id}', { params, body: { breakpoint } }),
  );
  await refreshDebugger(runtimeId);
}

export async function removeBreakpoint(runtimeId: string, id: number): Promise<void> {
  const params = { path: { runtime_id: runtimeId, id: String(id) } };
  await api.delete('/api/v1/runtimes/{runtime_id}/debug/breakpoints/{id}', { params });
  await refreshDebugger(runtimeId);
}

export async function enableBreakpoints(runtimeId: string, enabled: boolean): Promise<void> {
  const state = await compiled(runtimeId, () =>
    api.put('/api/v1/runtimes/{runtime_id}/debug/breakpoints', { ...at(runtimeId), body: { enabled } }),
  );
  debugStateRead(runtimeId, state);
}

export async function removeBreakpoints(runtimeId: string): Promise<void> {
  await api.delete('/api/v1/runtimes/{runtime_id}/debug/breakpoints', at(runtimeId));
  await refreshDebugger(runtimeId);
}

/** Halt, go on, step. Of several halted tasks the one that is looked at is stepped. */
export async function control(runtimeId: string, command: ControlOrder['command'], place?: Spot): Promise<void> {
  const debugged = useDebugger.getState().runtimes[runtimeId];
  const task = command === 'continue' || command === 'pause' ? null : (debugged?.task ?? null);
  const state = await compiled(runtimeId, () =>
    api.post('/api/v1/runtimes/{runtime_id}/debug/control', {
      ...at(runtimeId),
      body: { command, task, place: place ?? null },
    }),
  );
  debugStateRead(runtimeId, state);
  const halted = state.halted.find((halt) => halt.task === task) ?? state.halted[0];
  if (halted !== undefined) await showStack(runtimeId, halted.task);
}

export async function setDebugSettings(runtimeId: string, settings: DebugSettings): Promise<void> {
  const order = { ...at(runtimeId), body: { settings } };
  debugStateRead(runtimeId, await api.put('/api/v1/runtimes/{runtime_id}/debug/settings', order));
}

/** Looks at a halted task: its stack, its innermost level, and the place where it stands. */
export async function showStack(runtimeId: string, task: string): Promise<void> {
  const params = { path: { runtime_id: runtimeId }, query: { task } };
  const stack = await api.get('/api/v1/runtimes/{runtime_id}/debug/stack', { params });
  stackRead(runtimeId, task, stack.frames);
  // The innermost level with a place in the project: libraries run as they are.
  const first = stack.frames.find(({ place }) => place.object_id !== null) ?? stack.frames[0];
  if (first !== undefined) await showFrame(runtimeId, first, false);
}

/** Looks at a level of the stack: its variables, and its place in the editor. */
export async function showFrame(runtimeId: string, frame: StackFrame, focus: boolean): Promise<void> {
  const task = useDebugger.getState().runtimes[runtimeId]?.task;
  if (task == null) return;
  variablesRead(runtimeId, frame.index, []);
  if (frame.place.object_id !== null) goToSpot(frame.place, focus);
  await readVariables(runtimeId, task, frame.index);
}

async function readVariables(runtimeId: string, task: string, frame: number): Promise<void> {
  const params = { path: { runtime_id: runtimeId, frame: String(frame) }, query: { task } };
  const { variables } = await api.get('/api/v1/runtimes/{runtime_id}/debug/stack/{frame}/variables', { params });
  const now = useDebugger.getState().runtimes[runtimeId];
  if (now?.task === task && now.frame === frame) variablesRead(runtimeId, frame, variables);
}

/** Writes a variable of the level that is looked at. */
export async function writeVariable(runtimeId: string, variable: FrameVariable, value: string): Promise<void> {
  const { task, frame } = useDebugger.getState().runtimes[runtimeId] ?? {};
  if (task == null || frame === undefined) return;
  if (variable.path == null) {
    const params = { path: { runtime_id: runtimeId, frame: String(frame) } };
    const body = { task, name: variable.name, value };
    await api.post('/api/v1/runtimes/{runtime_id}/debug/stack/{frame}/write', { params, body });
  } else {
    const body = { values: [{ expression: variable.path, value }] };
    await api.post('/api/v1/runtimes/{runtime_id}/values/write', { ...at(runtimeId), body });
  }
  await readVariables(runtimeId, task, frame);
}

/** Opens the object of a spot at its line. */
export function goToSpot({ pou, uri, line, object_id, part, element }: StackFrame['place'], focus = true): void {
  const place = part === 'declaration' || part === 'implementation' ? part : null;
  jumpToFrame({ pou, uri, line, object_id: object_id ?? null, part: place, element: element ?? null }, focus);
}
