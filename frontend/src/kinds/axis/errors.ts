/** Errors of axes and of their function blocks in plain words, with the remedy. */
import type { TextKey } from '@/i18n';

const KNOWN = [
  'SMC_DI_GENERAL_COMMUNICATION_ERROR',
  'SMC_DI_AXIS_ERROR',
  'SMC_DI_FIELDBUS_LOST_SYNCRONICITY',
  'SMC_DI_SWLIMITS_EXCEEDED',
  'SMC_DI_HWLIMITS_EXCEEDED',
  'SMC_DI_VOLTAGE_DISABLED',
  'SMC_DI_POSITIONLAGERROR',
  'SMC_DI_HOMING_ERROR',
  'SMC_REGULATOR_OR_START_NOT_SET',
  'SMC_WRONG_CONTROLLER_MODE',
  'SMC_AXIS_IS_NOT_OPERATIONAL',
  'SMC_FB_WASNT_CALLED_DURING_MOTION',
  'SMC_AXIS_REF_CHANGED_DURING_OPERATION',
  'SMC_FB_ACTIVE_AXIS_DISABLED',
  'SMC_AXIS_NOT_READY_FOR_MOTION',
  'SMC_VD_MAX_VELOCITY_EXCEEDED',
  'SMC_VD_MAX_ACCELERATION_EXCEEDED',
  'SMC_VD_MAX_DECELERATION_EXCEEDED',
  'SMC_P_FTASKCYCLE_EMPTY',
  'SMC_R_NO_ERROR_TO_RESET',
  'SMC_R_DRIVE_DOESNT_ANSWER_IN_TIME',
  'SMC_MS_AXIS_IN_ERRORSTOP',
  'SMC_BLOCKING_MC_STOP_WASNT_CALLED',
  'SMC_MA_INVALID_VELACC_VALUES',
  'SMC_MR_INVALID_VELACC_VALUES',
  'SMC_MV_INVALID_ACCDEC_VALUES',
  'SMC_MS_AXIS_ALREADY_STOPPING',
  'SMC_INVALID_SET_VALUES',
] as const;
type KnownError = (typeof KNOWN)[number];

const known: ReadonlySet<string> = new Set(KNOWN);

function isKnown(name: string): name is KnownError {
  return known.has(name);
}

/** What happened and what to do; of an error without words of its own where they are found. */
export function errorText(name: string): { what: TextKey; remedy: TextKey } {
  if (!isKnown(name)) return { what: 'axisError.other', remedy: 'axisError.otherRemedy' };
  return { what: `axisError.${name}`, remedy: `axisRemedy.${name}` };
}
