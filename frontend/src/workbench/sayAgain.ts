/** What the server has said in another language: forgotten, and asked again where it is shown. */
import { keys, queryClient } from '@/api/queries';

/** States, logs and exceptions of controllers, and results of tests; reports of acts stay as they were given. */
export async function sayAgain(): Promise<void> {
  // The log is kept and only its new lines are asked for.
  queryClient.removeQueries({ predicate: ({ queryKey }) => queryKey.at(-1) === 'log', type: 'inactive' });
  await queryClient.resetQueries({ predicate: ({ queryKey }) => queryKey.at(-1) === 'log' });
  await Promise.all([
    queryClient.invalidateQueries({ queryKey: keys.runtimes }),
    queryClient.invalidateQueries({ predicate: ({ queryKey }) => queryKey.includes('testRun') }),
  ]);
}
