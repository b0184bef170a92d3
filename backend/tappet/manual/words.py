"""What pages say besides the comments of the library, in English and Chinese."""

from __future__ import annotations

from tappet.translation.language import Language

_WORDS: dict[str, tuple[str, str]] = {
    "comma": (", ", "，"),
    "title": ("Blocks and types of {library}", "{library} 的功能块和类型"),
    "intro": (
        "Made from the sources of the library by `make generate`; every chart is recorded from the example "
        "below it, with a cycle of {cycle} ms.",
        "本页由 `make generate` 根据库的源代码生成；每个时序图都是其下方示例的实际运行记录，"
        "周期为 {cycle} ms。",
    ),
    "other language": ("[中文](zh/{page})", "[English](../{page})"),
    "general": ("Rules of all blocks", "所有功能块的规则"),
    "name": ("Name", "名称"),
    "kind": ("Kind", "种类"),
    "what": ("What it is", "说明"),
    "type": ("Type", "类型"),
    "default": ("Default", "默认值"),
    "meaning": ("Meaning", "含义"),
    "number": ("Number", "编号"),
    "value": ("Value", "值"),
    "index": ("All blocks and types", "全部功能块和类型"),
    "source": ("Source", "源代码"),
    "returns": ("Returns `{type}`.", "返回 `{type}`。"),
    "extends": (
        "Extends {type}: what that has is here as well.",
        "扩展自 {type}：其全部成员在此同样可用。",
    ),
    "stands for": ("Stands for `{type}`.", "等同于 `{type}`。"),
    "in_out": ("Inputs and outputs (VAR_IN_OUT)", "输入输出（VAR_IN_OUT）"),
    "inputs": ("Inputs (VAR_INPUT)", "输入（VAR_INPUT）"),
    "outputs": ("Outputs (VAR_OUTPUT)", "输出（VAR_OUTPUT）"),
    "members": ("Members", "成员"),
    "values": ("Values", "枚举值"),
    "parameters": ("Parameters of the library", "库参数"),
    "methods": ("Methods", "方法"),
    "state": ("Axis state", "轴状态"),
    "state before": ("State before", "调用前的状态"),
    "state after": ("State then, or error", "之后的状态或错误"),
    "errors": ("Errors", "错误"),
    "own errors": (
        "Those of the block itself; errors of the axis and of its state come besides ([rules](README.md)).",
        "以下为该功能块自身的错误；轴及轴状态的错误另见[规则](README.md)。",
    ),
    "timing": ("Timing chart", "时序图"),
    "chart": (
        "Recorded from the example, {cycles} cycles of {cycle} ms. High is TRUE.",
        "由示例记录，共 {cycles} 个周期，每个周期 {cycle} ms。高电平为 TRUE。",
    ),
    "example": ("Example", "示例"),
    "example text": (
        "Complete program for a project with {axes} ([how to run it](../examples/README.md)); "
        "[file]({file}).",
        "完整程序，用于含有{axes}的工程（[如何运行](../../zh/examples.md)）；[文件]({file})。",
    ),
    "axis": ("the axis `{name}`", "轴 `{name}`"),
    "axes": ("the axes {names}", "轴 {names}"),
    "no axis": ("no axis", "任意轴配置"),
    "used by": ("Used by", "使用者"),
    "function_block": ("function block", "功能块"),
    "function": ("function", "函数"),
    "struct": ("structure", "结构体"),
    "union": ("union", "联合体"),
    "enum": ("enumeration", "枚举"),
    "alias": ("alias", "别名"),
    "parameter_list": ("parameter list", "参数列表"),
    "interface": ("interface", "接口"),
}

GROUPS: dict[str, tuple[str, str]] = {
    "administrative": ("Administrative", "管理功能块"),
    "single": ("Single axis", "单轴运动"),
    "profiles": ("Profiles", "曲线运动"),
    "homing": ("Homing", "回零"),
    "coupled": ("Master and slave", "主轴与从轴"),
    "cams": ("Cams", "凸轮"),
    "tappets": ("Tappets and cam switches", "挺杆与凸轮开关"),
    "files": ("Cam files", "凸轮文件"),
    "set_values": ("Set values from the program", "由程序给定设定值"),
    "probe": ("Touch probe", "探针"),
    "diagnosis": ("Status and diagnosis", "状态与诊断"),
    "parameters": ("Parameters and limits", "参数与限制"),
    "drives": ("Axes and drives", "轴与驱动器"),
    "portals": ("Portals", "龙门系统"),
    "arms": ("SCARA, palletizers and robots", "SCARA、码垛机与机器人"),
    "parallel": ("Parallel kinematics", "并联运动系统"),
    "preprocessing": ("Path preprocessing", "路径预处理"),
    "frames": ("Directions and coordinate systems", "方向与坐标系"),
    "other": ("Others", "其他"),
    "types": ("Types", "类型"),
}
"""The groups of the index, in its order."""

_STATES: dict[str, tuple[str, str]] = {
    "none": ("The block does not change the state of the axis.", "该功能块不改变轴的状态。"),
    "superimposed": (
        "The motion lies over the one of the axis, whose state stays; only an axis in standstill goes into "
        "`discrete_motion`.",
        "该运动叠加在轴的当前运动之上，轴状态保持不变；仅当轴处于静止时才进入 `discrete_motion`。",
    ),
    "overlay": (
        "The motion lies over the one of the axis, whose state stays.",
        "该运动叠加在轴的当前运动之上，轴状态保持不变。",
    ),
    "through": (
        "`discrete_motion` until the position is reached, `continuous_motion` from then on.",
        "到达目标位置之前为 `discrete_motion`，之后为 `continuous_motion`。",
    ),
    "discrete": (
        "`discrete_motion` until the command is over, then `standstill`.",
        "命令执行期间为 `discrete_motion`，结束后为 `standstill`。",
    ),
    "continuous": (
        "`continuous_motion` until another command has the axis.",
        "`continuous_motion`，直到另一条命令接管轴。",
    ),
    "jog": (
        "`continuous_motion` while an input is TRUE; then `discrete_motion` until the axis stands.",
        "输入为 TRUE 期间为 `continuous_motion`；随后为 `discrete_motion`，直到轴静止。",
    ),
    "synchronized": (
        "`synchronized_motion` for the slave, or the axis whose set values are written; a master keeps "
        "its state.",
        "从轴（或被写入设定值的轴）为 `synchronized_motion`；主轴保持自身状态。",
    ),
    "release": (
        "The slave goes from `synchronized_motion` into `continuous_motion`, with the velocity that it has.",
        "从轴由 `synchronized_motion` 进入 `continuous_motion`，保持当前速度。",
    ),
    "halt": (
        "`discrete_motion` while the axis brakes, then `standstill`; other commands may take over.",
        "制动期间为 `discrete_motion`，随后为 `standstill`；其他命令可以接管。",
    ),
    "stop": (
        "`stopping` as long as the axis moves or Execute is TRUE, then `standstill`; no command is taken "
        "meanwhile.",
        "只要轴在运动或 Execute 为 TRUE 即为 `stopping`，随后为 `standstill`；其间不接受任何命令。",
    ),
    "homing": (
        "`homing` until the command is over, then `standstill`.",
        "命令执行期间为 `homing`，结束后为 `standstill`。",
    ),
    "reset": (
        "`errorstop` becomes `standstill`, without power `power_off`.",
        "`errorstop` 变为 `standstill`；未上电时变为 `power_off`。",
    ),
    "power": (
        "Power on: `power_off` becomes `standstill`, with an error of the axis `errorstop`. Power off: "
        "every state but `errorstop` becomes `power_off`.",
        "上电：`power_off` 变为 `standstill`，轴有错误时变为 `errorstop`。断电：除 `errorstop` "
        "外的所有状态变为 `power_off`。",
    ),
}
"""What a block does to the state of its axis."""


def word(key: str, language: Language, **facts: object) -> str:
    """A word or sentence of the pages."""
    return _WORDS[key][language == "zh"].format(**facts) if facts else _WORDS[key][language == "zh"]


def group(key: str, language: Language) -> str:
    """Title of a group."""
    return GROUPS[key][language == "zh"]


def state(key: str, language: Language) -> str:
    """What a block does to the state of its axis; empty for blocks without one."""
    return _STATES[key][language == "zh"] if key else ""
