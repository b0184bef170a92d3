/** Unsaved text on this computer, so that a closed tab, a crash or a dead server loses nothing. */
import type { StoredVersion, TextParts } from './documentState';

export interface Draft {
  readonly base: StoredVersion;
  readonly text: TextParts;
  /** Milliseconds since 1970. */
  readonly savedAt: number;
}

/** The part of `localStorage` that is needed. */
export interface DraftStorage {
  getItem: (key: string) => string | null;
  setItem: (key: string, value: string) => void;
  removeItem: (key: string) => void;
  readonly length: number;
  key: (index: number) => string | null;
}

const PREFIX = 'tappet.draft.';
/** Drafts nobody came back to are dropped after this time. */
const KEEP_MS = 30 * 24 * 3600 * 1000;

export class Drafts {
  constructor(private readonly storage: DraftStorage) {}

  private key(user: string, projectId: string, objectId: string): string {
    return `${PREFIX}${user}.${projectId}.${objectId}`;
  }

  read(user: string, projectId: string, objectId: string): Draft | null {
    const text = this.storage.getItem(this.key(user, projectId, objectId));
    if (text === null) return null;
    try {
      const draft: unknown = JSON.parse(text);
      return isDraft(draft) ? draft : null;
    } catch {
      return null;
    }
  }

  /** False when the browser has no room left: then the text lives in this tab alone. */
  write(user: string, projectId: string, objectId: string, draft: Draft): boolean {
    try {
      this.storage.setItem(this.key(user, projectId, objectId), JSON.stringify(draft));
      return true;
    } catch {
      return false;
    }
  }

  remove(user: string, projectId: string, objectId: string): void {
    this.storage.removeItem(this.key(user, projectId, objectId));
  }

  /** Drops drafts that are older than a month. */
  prune(now: number): void {
    const keys = Array.from({ length: this.storage.length }, (_, i) => this.storage.key(i) ?? '');
    for (const key of keys.filter((k) => k.startsWith(PREFIX))) {
      try {
        const draft: unknown = JSON.parse(this.storage.getItem(key) ?? 'null');
        if (!isDraft(draft) || now - draft.savedAt > KEEP_MS) this.storage.removeItem(key);
      } catch {
        this.storage.removeItem(key);
      }
    }
  }
}

function isParts(value: unknown): value is TextParts {
  const parts = value as Partial<TextParts> | null;
  return typeof parts?.declaration === 'string' && typeof parts.implementation === 'string';
}

function isDraft(value: unknown): value is Draft {
  const draft = value as Partial<Draft> | null;
  return (
    draft !== null &&
    typeof draft === 'object' &&
    typeof draft.savedAt === 'number' &&
    typeof draft.base?.revision === 'number' &&
    isParts(draft.base.parts) &&
    isParts(draft.text)
  );
}
