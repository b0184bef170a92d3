/**
 * The view of a path on the server, and what is known of it: program, looks and chosen line go there when they have
 * changed, the newest ones only, one after the other.
 */
import { api, ApiError } from '@/api/client';
import type { components } from '@/api/schema';
import type { CncProgramData } from '../properties';
import type { Ray } from './projection';

type Schemas = components['schemas'];
export type PathSummary = Schemas['PathSummary'];
export type PathElement = Schemas['PathElement'];
export type PathMark = Schemas['PathMark'];
export type PathSamples = Schemas['PathSamples'];
export type PathLooks = Schemas['PathLooks'];
export type Colouring = NonNullable<PathLooks['colouring']>;

/** What the server is asked; tests have their own. */
export interface PathServer {
  begin: (looks: PathLooks) => Promise<{ view_id: string; path: string }>;
  end: (view: string) => Promise<unknown>;
  draw: (view: string, program: CncProgramData | null, looks: PathLooks) => Promise<PathSummary>;
  look: (view: string, looks: PathLooks) => Promise<PathSummary>;
  choose: (view: string, line: number | null) => Promise<readonly PathElement[]>;
  pick: (view: string, ray: Ray, angle: number) => Promise<Schemas['PickedElement']>;
  motion: (view: string) => Promise<PathSamples>;
}

export interface PathState {
  /** The page of the view; null before there is one. */
  readonly path: string | null;
  readonly summary: PathSummary | null;
  readonly chosen: readonly PathElement[];
  /** Something newer than what is shown is being made. */
  readonly busy: boolean;
  readonly error: unknown;
}

/** What is to be shown. `version` tells one program from another; `read` is called when it is its turn. */
export interface Wanted {
  readonly version: string;
  readonly read: () => CncProgramData | null;
  readonly looks: PathLooks;
  readonly line: number | null;
}

const NOTHING: PathState = { path: null, summary: null, chosen: [], busy: true, error: null };

export class PathView {
  private state = NOTHING;
  private wanted: Wanted | null = null;
  private view: string | null = null;
  private shown: { version: string | null; looks: string; line: number | null } = NEVER;
  private running = false;
  private closed = false;

  constructor(
    private readonly server: PathServer,
    private readonly onState: (state: PathState) => void,
  ) {}

  /** Shows something else; soon, if something is on its way. */
  show(wanted: Wanted): void {
    this.wanted = wanted;
    if (!this.running && !this.closed) void this.run();
  }

  /** After a failure: again from the beginning. */
  retry(): void {
    this.forget();
    this.put({ path: null, summary: null, chosen: [], error: null });
    if (this.wanted !== null) this.show(this.wanted);
  }

  pick(ray: Ray, angle: number): Promise<Schemas['PickedElement'] | null> {
    return this.view === null ? Promise.resolve(null) : this.server.pick(this.view, ray, angle);
  }

  motion(): Promise<PathSamples | null> {
    return this.view === null ? Promise.resolve(null) : this.server.motion(this.view);
  }

  /** It may show something, again after it was closed. */
  open(): void {
    this.closed = false;
    if (this.wanted !== null) this.show(this.wanted);
  }

  close(): void {
    this.closed = true;
    if (this.view !== null) void this.server.end(this.view).catch(() => undefined);
    this.forget();
  }

  private async run(): Promise<void> {
    this.running = true;
    try {
      while (!this.closed && (await this.step()));
      this.put({ busy: false });
    } catch (error) {
      if (error instanceof ApiError && error.status === 404 && this.view !== null) {
        // The view made room for others: begin another one.
        this.forget();
        this.put({ path: null, busy: true });
        this.running = false;
        void this.run();
        return;
      }
      this.put({ busy: false, error });
    } finally {
      this.running = false;
    }
  }

  /** One thing that the server does not know yet; false when there is none. */
  private async step(): Promise<boolean> {
    const wanted = this.wanted;
    if (wanted === null) return false;
    const looks = JSON.stringify(wanted.looks);
    if (this.view === null) {
      this.put({ busy: true, error: null });
      const { view_id, path } = await this.server.begin(wanted.looks);
      if (this.closed) {
        void this.server.end(view_id).catch(() => undefined);
        return false;
      }
      this.view = view_id;
      this.put({ path });
    } else if (this.shown.version !== wanted.version) {
      this.put({ busy: true });
      const summary = await this.server.draw(this.view, wanted.read(), wanted.looks);
      this.shown = { version: wanted.version, looks, line: null };
      this.put({ summary, chosen: [], error: null });
    } else if (this.shown.looks !== looks) {
      this.put({ busy: true });
      const summary = await this.server.look(this.view, wanted.looks);
      this.shown = { ...this.shown, looks, line: null };
      this.put({ summary });
    } else if (this.shown.line !== wanted.line) {
      const chosen = await this.server.choose(this.view, wanted.line);
      this.shown = { ...this.shown, line: wanted.line };
      this.put({ chosen });
    } else return false;
    return true;
  }

  private forget(): void {
    this.view = null;
    this.shown = NEVER;
  }

  private put(change: Partial<PathState>): void {
    this.state = { ...this.state, ...change };
    if (!this.closed) this.onState(this.state);
  }
}

const NEVER = { version: null, looks: '', line: null };

export const NO_PATH = NOTHING;

export function pathServer(projectId: string, objectId: string): PathServer {
  const at = (view: string) => ({ path: { project_id: projectId, view_id: view } });
  return {
    begin: (looks) =>
      api.post('/api/v1/projects/{project_id}/paths', {
        params: { path: { project_id: projectId } },
        body: { looks },
      }),
    end: (view) => api.delete('/api/v1/projects/{project_id}/paths/{view_id}', { params: at(view) }),
    draw: (view, program, looks) =>
      api.put('/api/v1/projects/{project_id}/paths/{view_id}/program', {
        params: at(view),
        body: { object_id: objectId, program, looks },
      }),
    look: (view, looks) =>
      api.put('/api/v1/projects/{project_id}/paths/{view_id}/looks', { params: at(view), body: looks }),
    choose: async (view, line) =>
      (await api.put('/api/v1/projects/{project_id}/paths/{view_id}/line', { params: at(view), body: { line } }))
        .elements,
    pick: (view, { origin, ahead }, angle) =>
      api.post('/api/v1/projects/{project_id}/paths/{view_id}/pick', {
        params: at(view),
        body: { origin: [...origin], ahead: [...ahead], angle },
      }),
    motion: (view) => api.get('/api/v1/projects/{project_id}/paths/{view_id}/motion', { params: at(view) }),
  };
}
