import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import '@fontsource-variable/inter';
import '@fontsource/jetbrains-mono/400.css';
import '@fontsource/jetbrains-mono/600.css';
import './tokens.css';
import './global.css';
import { App } from './App';
import { startPreferences } from '@/session/preferences';
import { saveSettingsWhenThePageGoes } from '@/session/settingsLater';
import { registerKinds } from '@/kinds/register';

await startPreferences();
saveSettingsWhenThePageGoes();
registerKinds();
const root = document.getElementById('root');
if (root) {
  createRoot(root).render(
    <StrictMode>
      <App />
    </StrictMode>,
  );
}
