import { QueryClientProvider, useQuery } from '@tanstack/react-query';
import { lazy, Suspense, useEffect } from 'react';
import { api, setUnauthorisedListener } from '@/api/client';
import { queryClient } from '@/api/queries';
import { DialogHost } from '@/ui/dialogs';
import { Failed, Loading } from '@/ui/Empty';
import { ErrorBoundary } from '@/ui/ErrorBoundary';
import { Notices } from '@/ui/Notices';
import { TooltipProvider } from '@/ui/Tooltip';
import { FirstAccountPage } from './login/FirstAccountPage';
import { LoginPage } from './login/LoginPage';
import { adoptPreferences } from '@/session/preferences';
import { listenToRoute, useRoute } from '@/session/route';
import { setUser, useSession } from '@/session/session';

// Who logs in waits for the login page only; the rooms of the workbench come with the first project.
const StartPage = lazy(() => import('./start/StartPage'));
const Workbench = lazy(() => import('./rooms'));

const TOOLTIP_DELAY_MS = 450;

export function App() {
  return (
    <QueryClientProvider client={queryClient}>
      <TooltipProvider delayDuration={TOOLTIP_DELAY_MS} skipDelayDuration={150}>
        <ErrorBoundary resetKey="app">
          <Suspense fallback={<Loading />}>
            <Page />
          </Suspense>
        </ErrorBoundary>
        <DialogHost />
        <Notices />
      </TooltipProvider>
    </QueryClientProvider>
  );
}

/** First account, login, start page or workbench, by what the server says about this browser. */
function Page() {
  const user = useSession((state) => state.user);
  const route = useRoute();
  const status = useQuery({
    queryKey: ['auth', 'status', user?.id ?? ''],
    queryFn: () => api.get('/api/v1/auth/status'),
    staleTime: Infinity,
    retry: false,
  });
  useEffect(() => listenToRoute(), []);
  useEffect(() => {
    setUnauthorisedListener(() => setUser(null));
    return () => setUnauthorisedListener(() => undefined);
  }, []);
  const known = status.data?.user ?? null;
  useEffect(() => {
    if (!known) return;
    setUser(known);
    void adoptPreferences(known);
  }, [known]);

  if (user)
    return route.page === 'project' ? <Workbench key={route.projectId} projectId={route.projectId} /> : <StartPage />;
  if (status.isError) return <Failed error={status.error} retry={() => void status.refetch()} />;
  if (!status.data || known) return <Loading />;
  return status.data.first_account_needed ? <FirstAccountPage /> : <LoginPage />;
}
