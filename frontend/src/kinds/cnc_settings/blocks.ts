/** Blocks of path preprocessing and the chain that the settings make of them (CNCS-03 to CNCS-09). */
import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { components } from '@/api/schema';
import type { DataOfKind } from '@/api/types';

export type PathBlock = components['schemas']['CncBlock'];
export type BlockParameter = components['schemas']['CncBlockParameter'];
export type Chain = DataOfKind['cnc_settings']['preprocessing'];
export type Instance = Chain[number];

/** The blocks that the library offers. */
export function usePathBlocks(projectId: string) {
  return useQuery({
    queryKey: ['cncBlocks', projectId],
    queryFn: async () =>
      (await api.get('/api/v1/projects/{project_id}/cnc/blocks', { params: { path: { project_id: projectId } } }))
        .blocks,
    staleTime: Infinity,
  });
}

/** The chain with a further instance behind the one at `behind`. */
export function withInstance(chain: Chain, block: string, behind: number): Chain {
  return [...chain.slice(0, behind + 1), { block, parameters: [] }, ...chain.slice(behind + 1)];
}

/** The value that an input has in an instance. */
export function valueOf(instance: Instance, { name, initial }: BlockParameter): string {
  return instance.parameters.find((one) => one.name.toLowerCase() === name.toLowerCase())?.value ?? initial;
}

const NUMBER = /^[+-]?\d+(\.\d*)?([eE][+-]?\d+)?$/;
const RANGES: Readonly<Record<string, readonly [number, number]>> = {
  BYTE: [0, 255],
  USINT: [0, 255],
  SINT: [-128, 127],
  WORD: [0, 65535],
  UINT: [0, 65535],
  INT: [-32768, 32767],
  DWORD: [0, 4294967295],
  UDINT: [0, 4294967295],
  DINT: [-2147483648, 2147483647],
};

/** Whether a text can be the value of an input. */
export function fits(value: string, { type, values }: BlockParameter): boolean {
  if (values.length > 0) return values.includes(value);
  const range = RANGES[type];
  if (!NUMBER.test(value) || !Number.isFinite(Number(value))) return false;
  return (
    range === undefined || (Number.isInteger(Number(value)) && Number(value) >= range[0] && Number(value) <= range[1])
  );
}

/** An instance with these values; inputs that have their initial one are left out. */
export function withValues(block: PathBlock, values: Readonly<Record<string, string>>): Instance {
  const changed = block.parameters.filter(({ name, initial }) => (values[name] ?? initial) !== initial);
  return { block: block.name, parameters: changed.map(({ name }) => ({ name, value: values[name]! })) };
}
