"""PLCopen XML: devices as CODESYS exports them; what their channels are mapped to becomes global variables.

The devices themselves are not read: their settings mean something only with their device descriptions.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from tappet.iec.tokens import NAME
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.plcopen_declarations import added
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.xml_tree import Element

MAPPING_LIST = "IoConfig_Globals_Mapping"
"""What CODESYS calls the list of the variables that a mapping declares."""
_BIT = re.compile(r"bit\d+", re.IGNORECASE)
_SHOWN = 8


class Channel(NamedTuple):
    """A channel of a device and what it is mapped to."""

    variable: str
    type: str
    """Empty where the export does not hold it."""
    label: str


def _inside(configuration: Element) -> list[Element]:
    return [
        found
        for _, holder in added(configuration)
        if holder.tag == "configurations"
        for found in holder.children("configuration")
    ]


def devices_below(configuration: Element) -> Iterator[Element]:
    """The `configuration` elements below one, parents before their children, up to other controllers."""
    waiting = _inside(configuration)[::-1]
    while waiting:
        item = waiting.pop()
        if item.child("resource") is None:
            yield item
            waiting += reversed(_inside(item))


def controllers_below(configuration: Element) -> list[Element]:
    """The nearest `configuration` elements below one that have applications of their own."""
    holders = [configuration, *devices_below(configuration)]
    return [item for holder in holders for item in _inside(holder) if item.child("resource") is not None]


def channels(configuration: Element) -> list[Channel]:
    """The mapped channels of one device, without those below it."""
    found: list[Channel] = []
    for _, device in added(configuration):
        if device.tag != "Device":
            continue
        for parameter in device.walk():
            mapping = parameter.child("Mapping") if parameter.tag == "Parameter" else None
            if mapping is None:
                continue
            title = parameter.child("Name")
            label = f"{configuration.get('name')}: {title.text().strip() if title is not None else ''}"
            kind = parameter.get("type")
            whole = kind.partition(":")[2] if kind.lower().startswith("std:") else ""
            if mapping.text().strip():
                found.append(Channel(mapping.text().strip(), whole, label))
            for part in mapping.walk():
                if part.tag == "Element" and part.text().strip():
                    bit = "BOOL" if _BIT.fullmatch(part.get("name")) else ""
                    found.append(Channel(part.text().strip(), bit, f"{label}, {part.get('name')}"))
    return found


def read_devices(
    source: str, configuration: Element, application: Draft | None, report: ImportReport
) -> None:
    """Say what of a device and of those below it is not read; declare the variables of their channels.

    A channel that is mapped to a name without a dot declares the variable in CODESYS; the others exist.
    """
    below = list(devices_below(configuration))
    settings = any(item.tag == "Device" for _, item in added(configuration))
    if settings or below:
        names = [item.get("name") for item in below]
        more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
        devices = f", nor are the devices below it ({', '.join(names[:_SHOWN])}{more})" if names else ""
        text = f"the settings of the device are not read{devices}; its applications are"
        report.add("refused", source, text, name=configuration.get("name"), line=configuration.line)
    mapped = [channel for item in (configuration, *below) for channel in channels(item)]
    declared = {
        channel.variable.upper(): channel for channel in reversed(mapped) if "." not in channel.variable
    }
    lines = [
        f"    {channel.variable} : {channel.type}; // {channel.label}"
        for channel in reversed(declared.values())
        if channel.type and NAME.fullmatch(channel.variable)
    ]
    if application is None or not lines:
        return
    declaration = "\n".join(["VAR_GLOBAL", *lines, "END_VAR"])
    line = configuration.line
    application.children.append(Draft("gvl", MAPPING_LIST, {"declaration": declaration}, source, line))
    text = (
        "holds the variables that channels of devices are mapped to; add the devices and map them again "
        "to join them with inputs and outputs"
    )
    report.add("changed", source, text, name=MAPPING_LIST, line=line)
