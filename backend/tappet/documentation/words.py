"""What a documentation says besides the texts of the project, in English and Chinese."""

from __future__ import annotations

from typing import Literal

Language = Literal["en", "zh"]

WORDS: dict[str, tuple[str, str]] = {
    "contents": ("Contents", "目录"),
    "page": ("Page {page} of {pages}", "第 {page} 页，共 {pages} 页"),
    "project": ("Project", "工程"),
    "company": ("Company", "公司"),
    "author": ("Author", "作者"),
    "printed": ("Printed", "打印时间"),
    "revision": ("Revision", "修订版"),
    "declaration": ("Declaration", "声明"),
    "implementation": ("Implementation", "实现"),
    "text": ("Text", "文本"),
    "variables": ("Variables", "变量"),
    "settings": ("Settings", "设置"),
    "name": ("Name", "名称"),
    "value": ("Value", "值"),
    "scope": ("Section", "区段"),
    "type": ("Type", "类型"),
    "initial": ("Initial value", "初始值"),
    "address": ("Address", "地址"),
    "comment": ("Comment", "注释"),
    "cross": ("Cross references by name", "按名称的交叉引用"),
    "places": ("Places", "位置"),
    "kept": (
        "The body is in {name} and was kept as another system has written it; it is not printed.",
        "主体使用 {name} 语言，按其他系统写入的形式保留，未打印。",
    ),
}


def word(key: str, language: Language, **values: str) -> str:
    """A text in a language."""
    return WORDS[key][0 if language == "en" else 1].format(**values)
