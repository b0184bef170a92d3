import { describe, expect, it } from 'vitest';
import type { ObjectSummary } from '@/api/types';
import { findTyped, forestOf, freeName, moveFocus, objectPath, rangeOf, rootsOf, rowsOf, topMost } from './tree';

const object = (id: string, parent_id: string | null, index = 0, kind: string = 'folder'): ObjectSummary => ({
  id,
  kind,
  parent_id,
  subkind: null,
  name: id,
  index,
  revision: 1,
  excluded: false,
});

const objects = [
  object('Device', null, 0, 'device'),
  object('Logic', 'Device', 0, 'plc_logic'),
  object('App', 'Logic', 0, 'application'),
  object('Beta', 'App', 1, 'pou'),
  object('Alpha', 'App', 0, 'pou'),
  object('Start', 'Beta', 0, 'method'),
  object('Shared', null, 0, 'pou'),
];
const forest = forestOf(objects);
const open = new Set(['Device', 'Logic', 'App']);
const names = (filter = '') =>
  rowsOf(forest, rootsOf(forest, 'devices'), open, filter).map((row) => `${row.level}${row.object.name}`);

describe('rows', () => {
  it('follow the order of the siblings, open objects only', () => {
    expect(names()).toEqual(['1Device', '2Logic', '3App', '4Alpha', '4Beta']);
  });

  it('show matches with their parents when filtered', () => {
    expect(names('star')).toEqual(['1Device', '2Logic', '3App', '4Beta', '5Start']);
  });

  it('keep the views apart', () => {
    expect(rootsOf(forest, 'pous').map((root) => root.id)).toEqual(['Shared']);
  });

  it('give position and number of siblings', () => {
    const rows = rowsOf(forest, rootsOf(forest, 'devices'), open);
    expect(rows.at(-1)).toMatchObject({ position: 2, siblings: 2, expandable: true, expanded: false });
  });
});

describe('keys', () => {
  const rows = rowsOf(forest, rootsOf(forest, 'devices'), open);
  it('go up and down and stop at the ends', () => {
    expect(moveFocus(rows, 'Device', 'up')).toEqual({ focus: 'Device' });
    expect(moveFocus(rows, 'App', 'down')).toEqual({ focus: 'Alpha' });
    expect(moveFocus(rows, null, 'down')).toEqual({ focus: 'Device' });
    expect(moveFocus(rows, 'Device', 'end')).toEqual({ focus: 'Beta' });
  });

  it('right opens or goes in, left closes or goes out', () => {
    expect(moveFocus(rows, 'Beta', 'right')).toEqual({ open: 'Beta' });
    expect(moveFocus(rows, 'App', 'right')).toEqual({ focus: 'Alpha' });
    expect(moveFocus(rows, 'App', 'left')).toEqual({ close: 'App' });
    expect(moveFocus(rows, 'Beta', 'left')).toEqual({ focus: 'App' });
    expect(moveFocus(rows, 'Alpha', 'right')).toEqual({});
  });

  it('find what is typed, from the focused row on, around the end', () => {
    expect(findTyped(rows, 'Device', 'a')).toBe('App');
    expect(findTyped(rows, 'App', 'a')).toBe('Alpha');
    expect(findTyped(rows, 'App', 'aa')).toBe('Alpha');
    expect(findTyped(rows, 'Beta', 'a')).toBe('App');
    expect(findTyped(rows, 'App', 'al')).toBe('Alpha');
    expect(findTyped(rows, 'Alpha', 'al')).toBe('Alpha');
    expect(findTyped(rows, 'App', 'x')).toBeNull();
  });

  it('select from the anchor on', () => {
    expect(rangeOf(rows, 'Alpha', 'Logic')).toEqual(['Logic', 'App', 'Alpha']);
    expect(rangeOf(rows, null, 'Logic')).toEqual(['Logic']);
  });
});

describe('objects', () => {
  it('have paths without the nodes that code does not name', () => {
    expect(objectPath(forest, 'Start')).toBe('Device.App.Beta.Start');
  });

  it('below another selected one are done with it', () => {
    expect(topMost(forest, ['Beta', 'Start', 'Alpha'])).toEqual(['Beta', 'Alpha']);
  });

  it('get free names', () => {
    expect(freeName(['POU', 'pou_1'], 'POU')).toBe('POU_2');
    expect(freeName(['POU_1'], 'POU_1')).toBe('POU_2');
    expect(freeName([], 'POU')).toBe('POU');
  });
});
