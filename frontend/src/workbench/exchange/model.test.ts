import { describe, expect, it } from 'vitest';
import type { ImportEntry } from '@/api/types';
import { objectSample } from '../../../tests/objectSample';
import { countOutcomes, placesOf, proposedPlace, readable, reportText, shownEntries } from './model';

const objects = [
  objectSample('plc', 'device', null),
  objectSample('logic', 'plc_logic', 'plc'),
  objectSample('app', 'application', 'logic'),
  objectSample('pumps', 'folder', 'app'),
  objectSample('fb', 'pou', 'pumps'),
  objectSample('shared', 'folder', null),
  objectSample('f', 'pou', null, 1),
];

describe('places of an import', () => {
  it('are applications, the POUs view and folders', () => {
    const places = placesOf(objects);
    expect(places.map((place) => [place.id, place.names.join('/')])).toEqual([
      ['app', 'PLC/APP'],
      ['pumps', 'PLC/APP/PUMPS'],
      ['pous', ''],
      ['shared', 'SHARED'],
    ]);
    const proposed = (id: string | null) =>
      proposedPlace(
        places,
        objects,
        objects.find((one) => one.id === id),
        'app',
      );
    expect(['fb', 'f', 'plc', null].map(proposed)).toEqual(['pumps', 'pous', 'app', 'app']);
  });
});

const entry = (outcome: ImportEntry['outcome'], name: string, text = '', line: number | null = 3): ImportEntry => ({
  source: 'a.xml',
  line,
  object: name,
  outcome,
  text,
  object_id: null,
});

describe('the report', () => {
  const entries = [
    entry('imported', 'FB_Pump'),
    entry('refused', '', 'is no XML', null),
    entry('changed', 'E', 'renamed'),
  ];

  it('is filtered and counted', () => {
    expect(shownEntries(entries, new Set(['imported']), '').map((one) => one.outcome)).toEqual(['refused', 'changed']);
    expect(shownEntries(entries, new Set(), 'XML no').map((one) => one.object)).toEqual([]);
    expect(shownEntries(entries, new Set(), 'Renamed').map((one) => one.object)).toEqual(['E']);
    expect(countOutcomes(entries)).toMatchObject({ imported: 1, changed: 1, kept: 0, refused: 1 });
  });

  it('is text for other programs', () => {
    expect(reportText(entries)).toBe(
      'a.xml:3: imported FB_Pump\na.xml: refused: is no XML\na.xml:3: changed E: renamed\n',
    );
  });
});

describe('files of a folder', () => {
  it('are those that are read, or all of a project of our own', () => {
    const formats = { endings: ['.tcpou', '.tctleo'], project_file: 'own.json' };
    const of = (...paths: string[]) => readable(formats, paths);
    expect(of('L/x.TcPOU', 'L/x.TcTLEO', 'L/x.png', 'L/.git/y.TcPOU')).toEqual(['L/x.TcPOU', 'L/x.TcTLEO']);
    expect(of('P/own.json', 'P/a.png', 'P/.git/c')).toEqual(['P/own.json', 'P/a.png']);
    expect(of('P/not-own.json', 'P/a.png')).toEqual([]);
  });
});
