import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { useLanguage } from '@/i18n';

/** The warnings of the compiler, in the language of the user. */
export function useCompilerWarnings() {
  const language = useLanguage();
  return useQuery({
    queryKey: ['compiler-warnings', language],
    queryFn: () => api.get('/api/v1/compiler-warnings', { params: { query: { language } } }),
    staleTime: Infinity,
  });
}
