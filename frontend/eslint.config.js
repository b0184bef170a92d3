import js from '@eslint/js';
import boundaries from 'eslint-plugin-boundaries';
import reactHooks from 'eslint-plugin-react-hooks';
import globals from 'globals';
import tseslint from 'typescript-eslint';

/**
 * The rooms of `src`, bottom to top: a file imports from its own room and from those above it in this list.
 * Rooms in `editors` are listed one by one, since they build on each other.
 */
const ROOMS = [
  'i18n',
  'icons',
  'api',
  'session',
  'iec',
  'project',
  'ui',
  'workbench',
  'text',
  'search',
  'bookmarks',
  'scripts',
  'compare',
  'lsp',
  'help',
  'online',
  'editors/form',
  'editors/crossReferences',
  'editors/assistant',
  'editors/online',
  'editors/documents',
  'editors/text',
  'editors/st',
  'editors/declaration',
  'editors/il',
  'editors/textObject',
  'editors',
  'kinds',
  'app',
];
const types = (rooms) => ({ element: { types: { anyOf: rooms } } });

export default tseslint.config(
  { ignores: ['dist', 'node_modules', 'src/api/schema.ts', 'src/iec/grammar.ts', 'test-results'] },
  js.configs.recommended,
  {
    files: ['**/*.{ts,tsx}'],
    extends: [...tseslint.configs.recommendedTypeChecked],
    languageOptions: {
      globals: globals.browser,
      parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname },
    },
    plugins: { 'react-hooks': reactHooks },
    rules: {
      ...reactHooks.configs.recommended.rules,
      'react-hooks/incompatible-library': 'off',
      'max-lines': ['error', { max: 400, skipBlankLines: true, skipComments: true }],
      eqeqeq: ['error', 'always', { null: 'ignore' }],
      'no-alert': 'error',
      'no-restricted-syntax': [
        'error',
        {
          selector: "JSXOpeningElement[name.name='button']:not(:has(> JSXAttribute[name.name='type']))",
          message: 'Say the type: a button without one submits the form of the dialog that it stands in.',
        },
      ],
      '@typescript-eslint/consistent-type-imports': 'error',
      '@typescript-eslint/no-misused-promises': ['error', { checksVoidReturn: { attributes: false } }],
      '@typescript-eslint/switch-exhaustiveness-check': ['error', { considerDefaultExhaustiveForUnions: true }],
      '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_', varsIgnorePattern: '^_' }],
    },
  },
  {
    files: ['src/**/*.{ts,tsx}'],
    ignores: ['src/**/*.test.{ts,tsx}', 'src/**/*.d.ts'],
    plugins: { boundaries },
    settings: {
      'boundaries/elements': ROOMS.map((room) => ({ type: room, pattern: `src/${room}` })),
      'boundaries/include': ['src/**/*.{ts,tsx}'],
      'import/resolver': { typescript: { project: 'tsconfig.app.json' } },
    },
    rules: {
      'boundaries/no-unknown-files': 'error',
      'boundaries/dependencies': [
        'error',
        {
          default: 'disallow',
          message: "The room '{{from.element.type}}' may not import from '{{to.element.type}}': rooms import one way.",
          policies: [
            ...ROOMS.map((room, at) => ({ from: types([room]), allow: { to: types(ROOMS.slice(0, at + 1)) } })),
          ],
        },
      ],
    },
  },
  { files: ['tests/**', '**/*.test.{ts,tsx}', 'vite.config.ts'], languageOptions: { globals: globals.node } },
  { files: ['**/*.js', '**/*.mjs'], languageOptions: { globals: globals.node } },
);
