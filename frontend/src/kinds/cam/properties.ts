/** The properties of what is selected (CAM-60 to CAM-64): their values, and what may be typed. Pure functions. */
import type { t as Text, TextKey } from '@/i18n';
import { numberText, typedNumber } from '@/editors/form/numbers';
import { heldReason, pointFault, rangeOf, jerkShown, rounded } from './cells';
import { domainOf, LAWS, type CamTable } from './camTable';
import type { CamEdit } from './edit';
import { movePoint, setInflection, setLaw } from './points';
import type { Selected } from './rows';
import { ACTIONS, isTrackId, moveToTrack, setTappet, tappetOf, type TappetPlace } from './tappets';

export interface Property {
  id: string;
  title: string;
  /** Groups for sorting by type. */
  group: 'place' | 'shape' | 'computed';
  value: string;
  about: string;
  /** What can be chosen; without it a text is typed. */
  choices?: readonly { value: string; text: string }[];
  check?: (text: string) => string | null;
  /** Takes a text that passed the check, or a choice; without it the property is read only. */
  set?: (text: string) => void;
}

/** Why a position of a tappet cannot be taken, or null. */
export function tappetFault(cam: CamTable, text: string): TextKey | null {
  const value = typedNumber(text);
  if (!Number.isFinite(value)) return 'cam.fault.number';
  const [first, last] = domainOf(cam);
  return value >= first && value <= last ? null : 'cam.fault.outside';
}

export function domainTexts(cam: CamTable): { least: string; greatest: string } {
  const [first, last] = domainOf(cam);
  return { least: numberText(first), greatest: numberText(last) };
}

export function propertiesOf(edit: CamEdit, selected: Selected, t: typeof Text): Property[] {
  const { cam, drawing, locked } = edit;
  if (selected.kind === 'point') {
    const { index } = selected;
    return (['x', 'y', 'v', 'a', 'j'] as const).map((name): Property => {
      const held = heldReason(cam, index, name);
      const value = name === 'j' ? jerkShown(edit, index) : cam.points[index]![name];
      return {
        id: name,
        title: t(`cam.column.${name}`),
        group: name === 'x' || name === 'y' ? 'place' : 'shape',
        value: value === null ? '' : numberText(value),
        about: held === null ? t(`cam.about.${name}`) : t(held),
        check: (text) => {
          const fault = pointFault(cam, index, name, text);
          return fault === null ? null : t(fault, rangeOf(cam, index));
        },
        set:
          held !== null || locked
            ? undefined
            : (text) => edit.change(movePoint(cam, index, { [name]: typedNumber(text) })),
      };
    });
  }
  if (selected.kind === 'segment') {
    const { index } = selected;
    const segment = cam.segments[index]!;
    const curve = drawing?.segments.length === cam.segments.length ? drawing.segments[index] : undefined;
    const law: Property = {
      id: 'law',
      title: t('cam.column.law'),
      group: 'shape',
      value: segment.law,
      about: t('cam.about.law'),
      choices: LAWS.map((value) => ({ value, text: t(`cam.law.${value}`) })),
      set: locked ? undefined : (value) => edit.change(setLaw(cam, index, value as typeof segment.law)),
    };
    const inflection: Property = {
      id: 'inflection',
      title: t('cam.inflection'),
      group: 'shape',
      value: numberText(segment.inflection),
      about: t('cam.about.inflection'),
      check: (text) => {
        const value = typedNumber(text);
        return value > 0 && value < 1 ? null : t('cam.fault.part');
      },
      set: locked ? undefined : (text) => edit.change(setInflection(cam, index, typedNumber(text))),
    };
    const computed = (['least', 'greatest', 'velocity', 'acceleration', 'jerk'] as const).map((name): Property => ({
      id: name,
      title: t(`cam.column.${name}`),
      group: 'computed',
      value: curve ? numberText(rounded(curve[name])) : '',
      about: t('cam.about.computed'),
    }));
    return [law, ...(segment.law === 'modified_sine' ? [inflection] : []), ...computed];
  }
  return tappetProperties(edit, selected, t);
}

function tappetProperties(edit: CamEdit, selected: TappetPlace, t: typeof Text): Property[] {
  const { cam, locked } = edit;
  const tappet = tappetOf(cam, selected);
  if (!tappet) return [];
  const track = cam.tracks[selected.track]!;
  const action = (name: 'positive' | 'negative'): Property => ({
    id: name,
    title: t(`cam.column.${name}`),
    group: 'shape',
    value: tappet[name],
    about: t(`cam.about.${name}`),
    choices: ACTIONS.map((value) => ({ value, text: t(`cam.action.${value}`) })),
    set: locked
      ? undefined
      : (value) => edit.change(setTappet(cam, selected, { [name]: value as typeof tappet.positive }).cam),
  });
  return [
    {
      id: 'track',
      title: t('cam.column.track'),
      group: 'place',
      value: String(track.id),
      about: t('cam.about.track'),
      check: (text) => (isTrackId(typedNumber(text)) ? null : t('cam.fault.track')),
      set: locked
        ? undefined
        : (text) => {
            const moved = moveToTrack(cam, selected, typedNumber(text));
            edit.change(moved.cam, { kind: 'tappet', ...moved.place });
          },
    },
    {
      id: 'x',
      title: t('cam.column.x'),
      group: 'place',
      value: numberText(tappet.x),
      about: t('cam.about.tappetX'),
      check: (text) => {
        const fault = tappetFault(cam, text);
        return fault === null ? null : t(fault, domainTexts(cam));
      },
      set: locked
        ? undefined
        : (text) => {
            const moved = setTappet(cam, selected, { x: typedNumber(text) });
            edit.change(moved.cam, { kind: 'tappet', ...moved.place });
          },
    },
    action('positive'),
    action('negative'),
  ];
}

export type Order = 'type' | 'name';

const GROUPS = ['place', 'shape', 'computed'];

/** By type as they come, or by name (CAM-61). */
export function ordered(properties: readonly Property[], order: Order, descending: boolean): Property[] {
  const sorted = [...properties].sort((one, other) =>
    order === 'name' ? one.title.localeCompare(other.title) : GROUPS.indexOf(one.group) - GROUPS.indexOf(other.group),
  );
  return descending ? sorted.reverse() : sorted;
}
