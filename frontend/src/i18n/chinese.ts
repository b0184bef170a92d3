/** The Chinese texts: fetched by those who read them. */
const FILES = import.meta.glob<Readonly<Record<string, string>>>(['./zh/*.json', '../{kinds,editors}/*/zh.json'], {
  eager: true,
  import: 'default',
});

export const CHINESE: Readonly<Record<string, string>> = Object.assign({}, ...Object.values(FILES)) as Readonly<
  Record<string, string>
>;
