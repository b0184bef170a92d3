/** Live values of a group and of its panel. */
export const groupPath = (name: string) => `IoConfig_Group_${name}.${name}`;
export const panelPath = (name: string) => `IoConfig_GroupPanel_${name}.${name}`;
