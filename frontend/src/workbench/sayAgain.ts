/** What the server has said in another language is asked again where it is shown. */
import { keys, queryClient } from '@/api/queries';

/** States of controllers and results of tests; reports of acts stay as they were given. */
export async function sayAgain(): Promise<void> {
  await Promise.all([
    queryClient.invalidateQueries({ queryKey: keys.runtimes }),
    queryClient.invalidateQueries({ predicate: ({ queryKey }) => queryKey.includes('testRun') }),
  ]);
}
