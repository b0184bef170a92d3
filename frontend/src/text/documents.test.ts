import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  edited, isChanged, newerVersion, opened, phaseOf, resolved, saved, savingFailed, savingStarted, wantsSaving, withDraft,
  type DocumentState, type TextParts,
} from './documentState'; // prettier-ignore
import { Drafts, type DraftStorage } from './drafts';

const parts = (implementation: string): TextParts => ({ declaration: 'PROGRAM P', implementation });
const version = (revision: number, text: string) => ({ revision, parts: parts(text) });

describe('a document', () => {
  it('is saved on top of the version it was made from', () => {
    let state = edited(opened(version(1, 'a')), parts('b'));
    expect(phaseOf(state)).toBe('changed');
    state = savingStarted(state);
    expect(phaseOf(state)).toBe('saving');
    expect(wantsSaving(state)).toBe(false);
    state = edited(state, parts('c'));
    state = saved(state, version(2, 'b'));
    expect(state.base.revision).toBe(2);
    expect(phaseOf(state)).toBe('changed');
    expect(phaseOf(saved(savingStarted(state), version(3, 'c')))).toBe('clean');
  });

  it('keeps the text when saving fails, and tries again', () => {
    const state = savingFailed(savingStarted(edited(opened(version(1, 'a')), parts('b'))), new Error('down'));
    expect(phaseOf(state)).toBe('failed');
    expect(wantsSaving(state)).toBe(true);
    expect(state.text.implementation).toBe('b');
  });

  it('follows somebody else while it is unchanged', () => {
    const state = newerVersion(opened(version(1, 'a')), version(2, 'x'));
    expect(state.text.implementation).toBe('x');
    expect(phaseOf(state)).toBe('clean');
    expect(newerVersion(state, version(1, 'old'))).toBe(state);
  });

  it('asks when both sides changed, and loses neither', () => {
    const state = newerVersion(edited(opened(version(1, 'a')), parts('mine')), version(2, 'theirs'));
    expect(phaseOf(state)).toBe('conflict');
    expect(wantsSaving(state)).toBe(false);
    expect(resolved(state, 'theirs').text).toEqual(parts('theirs'));
    const mine = resolved(state, 'mine');
    expect(mine.text).toEqual(parts('mine'));
    expect(mine.base.revision).toBe(2);
    expect(wantsSaving(mine)).toBe(true);
    expect(resolved(state, 'merged', parts('both')).text).toEqual(parts('both'));
  });

  it('does not take its own version, come back as an event, for somebody else\u2019s', () => {
    const state = savingStarted(edited(opened(version(1, 'a')), parts('b')));
    const typed = edited(state, parts('bc'));
    expect(phaseOf(newerVersion(typed, version(2, 'b')))).toBe('saving');
    expect(phaseOf(saved(newerVersion(typed, version(2, 'b')), version(2, 'b')))).toBe('changed');
  });

  it('is not disturbed by a new revision with the same text', () => {
    const state = edited(opened(version(1, 'a')), parts('b'));
    expect(phaseOf(newerVersion(state, version(2, 'a')))).toBe('changed');
    expect(phaseOf(newerVersion(state, version(2, 'b')))).toBe('clean');
  });

  it('takes up a draft, or puts it beside a newer version', () => {
    const now = opened(version(3, 'c'));
    expect(phaseOf(withDraft(now, { base: version(3, 'c'), text: parts('d') }))).toBe('changed');
    expect(withDraft(now, { base: version(3, 'c'), text: parts('c') })).toBe(now);
    const late = withDraft(now, { base: version(2, 'b'), text: parts('d') });
    expect(phaseOf(late)).toBe('conflict');
    expect(late.theirs?.parts).toEqual(parts('c'));
  });

  it('never drops typed text by itself', () => {
    type Act = { kind: 'type' | 'send' | 'ok' | 'fail' | 'other' };
    const act = fc.constantFrom<Act>(
      { kind: 'type' },
      { kind: 'send' },
      { kind: 'ok' },
      { kind: 'fail' },
      { kind: 'other' },
    );
    fc.assert(
      fc.property(fc.array(act, { maxLength: 25 }), (acts) => {
        let server = version(1, 'v1');
        let state: DocumentState = opened(server);
        let last = 'v1';
        acts.forEach(({ kind }, n) => {
          if (kind === 'type') state = edited(state, parts((last = `typed ${n}`)));
          else if (kind === 'send' && wantsSaving(state)) state = savingStarted(state);
          else if (kind === 'ok' && state.sent !== null) {
            if (state.base.revision === server.revision) {
              server = { revision: server.revision + 1, parts: state.sent };
              state = saved(state, server);
            } else state = newerVersion({ ...state, sent: null }, server);
          } else if (kind === 'fail' && state.sent !== null) state = savingFailed(state, 'x');
          else if (kind === 'other') {
            const untouched = !isChanged(state) && state.sent === null;
            server = version(server.revision + 1, `other ${n}`);
            state = newerVersion(state, server);
            if (untouched) last = `other ${n}`;
          }
          expect(state.text.implementation).toBe(last);
        });
      }),
    );
  });
});

class MemoryStorage implements DraftStorage {
  private readonly map = new Map<string, string>();
  full = false;
  get length() {
    return this.map.size;
  }
  key = (index: number) => [...this.map.keys()][index] ?? null;
  getItem = (key: string) => this.map.get(key) ?? null;
  setItem = (key: string, value: string) => {
    if (this.full) throw new DOMException('full', 'QuotaExceededError');
    this.map.set(key, value);
  };
  removeItem = (key: string) => void this.map.delete(key);
}

describe('drafts', () => {
  const draft = { base: version(1, 'a'), text: parts('b'), savedAt: 1000 };
  it('are kept per user, project and object', () => {
    const drafts = new Drafts(new MemoryStorage());
    expect(drafts.write('u', 'p', 'o', draft)).toBe(true);
    expect(drafts.read('u', 'p', 'o')).toEqual(draft);
    expect(drafts.read('v', 'p', 'o')).toBeNull();
    drafts.remove('u', 'p', 'o');
    expect(drafts.read('u', 'p', 'o')).toBeNull();
  });
  it('survive foreign content, a full store and old age', () => {
    const storage = new MemoryStorage();
    const drafts = new Drafts(storage);
    storage.setItem('tappet.draft.u.p.o', '{"base":1}');
    expect(drafts.read('u', 'p', 'o')).toBeNull();
    storage.setItem('tappet.draft.u.p.o', 'no json');
    expect(drafts.read('u', 'p', 'o')).toBeNull();
    drafts.write('u', 'p', 'new', { ...draft, savedAt: 40 * 24 * 3600 * 1000 });
    storage.setItem('other', 'stays');
    drafts.prune(41 * 24 * 3600 * 1000);
    expect(storage.getItem('tappet.draft.u.p.o')).toBeNull();
    expect(drafts.read('u', 'p', 'new')).not.toBeNull();
    expect(storage.getItem('other')).toBe('stays');
    storage.full = true;
    expect(drafts.write('u', 'p', 'o', draft)).toBe(false);
  });
});
