import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { useLanguage } from '@/i18n';

/** The coding rules that the server knows, in the language of the user. */
export function useRules() {
  const language = useLanguage();
  return useQuery({
    queryKey: ['static-analysis', 'rules', language],
    queryFn: () => api.get('/api/v1/static-analysis/rules', { params: { query: { language } } }),
    staleTime: Infinity,
  });
}
