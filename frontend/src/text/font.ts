/** The font of code. */
export const CODE_FONT = { family: "'JetBrains Mono'", size: 13 };

/** Loads the font; where it cannot be had, the next one of the family is taken. */
export async function loadCodeFont(): Promise<void> {
  // Not there in pages without a layout, as in tests.
  const fonts = document.fonts as FontFaceSet | undefined;
  await fonts?.load(`${String(CODE_FONT.size)}px ${CODE_FONT.family}`).catch(() => undefined);
}
