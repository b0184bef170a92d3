/** The part of Monaco's service registry that is not in its published types. */
declare module 'monaco-editor/editor/standalone/browser/standaloneServices' {
  export const StandaloneServices: { initialize: (services: Record<string, object>) => unknown };
}
