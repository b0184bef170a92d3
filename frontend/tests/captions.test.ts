// @vitest-environment happy-dom
import { describe, expect, it } from 'vitest';
import '@/app/rooms';
import { t } from '@/i18n';
import { useRegistry } from '@/workbench/commands';

/** Words that stay small within a title (The Chicago Manual of Style, headline style: articles, prepositions, ...). */
const SMALL = new Set(['a', 'an', 'and', 'as', 'at', 'by', 'for', 'from', 'in', 'of', 'on', 'or', 'the', 'to', 'with']);

const captions = [...useRegistry.getState().commands.values()].flatMap((command) => {
  const places = command.menu === undefined ? [] : Array.isArray(command.menu) ? command.menu : [command.menu];
  const submenus = places.map((place) => (place as { submenu?: Parameters<typeof t>[0] }).submenu);
  return [t(command.title, command.titleValues), ...submenus.filter((key) => key !== undefined).map((key) => t(key))];
});

function headline(caption: string): boolean {
  const words = caption.split(/\s+/).filter((word) => /^\p{L}/u.test(word));
  return words.every((word, at) => (at > 0 && SMALL.has(word)) || /^\p{Lu}/u.test(word));
}

describe('captions of commands', () => {
  it('are there', () => expect(captions.length).toBeGreaterThan(80));

  it('are in headline style in English', () => expect(captions.filter((one) => !headline(one))).toEqual([]));
});
