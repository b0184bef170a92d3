import { registerKinds } from '@/kinds/register';

registerKinds();
