"""Words for values that a design file gives and for those that it should give."""

from __future__ import annotations

import math
import re
from typing import Any
from unicodedata import normalize

from gearlink.cli.reading.units import without_unit
from gearlink.cli.reading.yaml_reader import plain_value
from gearlink.cli.reading.yaml_remedies import ODD, odd_character, odd_remedy

WANTED = {
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "float_parsing": "a number",
    "decimal_type": "a number",
    "string_type": "text",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "list_type": "a list such as [1, 2]",
    "tuple_type": "a list such as [1, 2]",
    "set_type": "a list such as [1, 2]",
    "dict_type": "a section of keys",
    "mapping_type": "a section of keys",
    "model_type": "a section of keys",
    "model_attributes_type": "a section of keys",
    "none_required": "empty",
}
_BOUNDS = {
    "greater_than": ("gt", "greater than {}"),
    "greater_than_equal": ("ge", "at least {}"),
    "less_than": ("lt", "less than {}"),
    "less_than_equal": ("le", "at most {}"),
    "multiple_of": ("multiple_of", "a multiple of {}"),
}
_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_WITH_UNIT = re.compile(rf"({_NUMBER})\s*((?:1?/)?[a-zA-Zµ°%'\"][\w/^°%² -]*)", re.ASCII)
DASHES = ("\u2212", "\u2013", "\u2014")
_LOOKALIKES = str.maketrans("OolI", "0011")
_SHOWN_CHARACTERS = 40
_LONG = 1e6
_INCH = 25.4


def shown(value: Any) -> str:
    """A value as a message names it."""
    if value is None:
        return "empty"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return repr(value if len(value) <= _SHOWN_CHARACTERS else value[: _SHOWN_CHARACTERS - 3] + "...")
    if isinstance(value, list):
        return "a list"
    if isinstance(value, float) and abs(value) >= _LONG and float(f"{value:g}") == value:
        return f"{value:g}"  # 1e+11, as it was written
    return "a section" if isinstance(value, dict) else repr(value)


def bound(kind: str, context: dict[str, Any]) -> str:
    """The limit that a number broke, or nothing where the error is another one."""
    if kind not in _BOUNDS:
        return ""
    name, words = _BOUNDS[kind]
    limit = context.get(name)
    return words.format(f"{limit:.15g}" if isinstance(limit, float) else limit)


def choices(context: dict[str, Any]) -> list[str]:
    """The values of a literal, as a design file writes them.

    Example
        >>> choices({"expected": "'arc', 'parabola' or 'quartic'"}), choices({"expected": "True"})
        (["'arc'", "'parabola'", "'quartic'"], ['true'])
    """
    words = re.findall(r"'[^']*'|[^\s,']+", str(context.get("expected", "")))
    return [{"True": "true", "False": "false"}.get(word, word) for word in words if word != "or"]


def whole_number_remedy(value: float) -> str:
    """What to write in place of a float where teeth or the like are counted."""
    if not math.isfinite(value) or abs(value) >= 2.0**53:
        return ""
    return f"write {int(value)}" if value == int(value) else f"write {math.floor(value)} or {math.ceil(value)}"


def number_remedy(text: str, unit: str = "") -> str:
    """What to write in place of a text that was meant as a number; nothing where that is not plain.

    Parameters
        unit : str - of the key, where it has one
    Example
        >>> number_remedy("38,8"), number_remedy("5 cm", "mm")
        ('write a decimal point: 38.8', 'keys carry no unit, this one is in mm: write 50')
        >>> number_remedy("25.4/12", "mm"), number_remedy("DP12", "mm")
        ('write 2.116666667', 'a diametral pitch counts teeth in an inch: write 2.116666667 (mm)')
    """
    text = text[:200].strip(" ")
    if isinstance(plain_value(text), (int, float)):
        return "leave the quotation marks out"
    if re.fullmatch(r"[-+]?[1-9][0-9]{0,2},[0-9]{3}", text):
        return f"write {text.replace(',', '.')}, or {text.replace(',', '')} where the comma parts thousands"
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", text):
        return f"write a decimal point: {text.replace(',', '.')}"
    if re.fullmatch(r"[-+]?[0-9]+(:[0-5]?[0-9])+(\.[0-9]*)?", text):
        return "write decimals, not minutes and seconds"
    if re.fullmatch(r"[-+]?[0-9]{1,3}([_ '][0-9]{3})+(\.[0-9]+)?", text):
        return f"write {re.sub('[_ ]', '', text.replace(chr(39), ''))}"
    if odd := ODD.search(text):
        plain = normalize("NFKC", text).replace("\u2212", "-").strip()
        if re.fullmatch(_NUMBER, plain):
            return f"it holds {odd_character(odd[0])}: write {plain}"
        return f"it holds {odd_character(odd[0])}: {odd_remedy(odd[0])}"
    if text[:1] in DASHES:
        return f"it holds {odd_character(text[0])}: write -"
    if re.fullmatch(rf"{_NUMBER}(\s+{_NUMBER})+", text):
        return f"commas part the elements of a list: {', '.join(text.split())}"
    digits = text.translate(_LOOKALIKES)
    if re.fullmatch(_NUMBER, digits):
        return f"a letter stands for a digit: write {digits}"
    if re.fullmatch(r"[-+]?0[xXbBoO]\w*", text, re.ASCII):
        return "write it in decimals"
    if re.fullmatch(r"[-+]?[0-9.]+[eE][-+]?[0-9_]*", text):
        return "write the exponent as in 1e3"
    if quotient := re.fullmatch(rf"({_NUMBER})\s*/\s*({_NUMBER})", text):
        return _quotient(float(quotient[1]), float(quotient[2]))
    if unit == "mm" and (pitch := re.fullmatch(rf"DP\s*({_NUMBER})|({_NUMBER})\s*DP", text, re.IGNORECASE)):
        return f"a diametral pitch counts teeth in an inch: {_quotient(_INCH, float(pitch[1] or pitch[2]))} (mm)"
    found = _WITH_UNIT.fullmatch(text)
    return without_unit(found[1], found[2], unit) if found else ""


def _quotient(value: float, divisor: float) -> str:
    """A quotient in decimals; nothing where there is none."""
    return f"write {value / divisor:.10g}" if divisor and math.isfinite(value / divisor) else "write it in decimals"


def list_remedy(text: str) -> str:
    """How numbers in a row are written as a list; nothing for other text.

    Example
        >>> list_remedy("20, 30"), list_remedy("20 30"), list_remedy("x")
        ('write it in brackets: [20, 30]', 'write it in brackets: [20, 30]', '')
    """
    numbers = re.split(r"\s*,\s*|\s+", text[:200].strip())
    if len(numbers) < 2 or not all(re.fullmatch(_NUMBER, number) for number in numbers):
        return ""
    return f"write it in brackets: [{', '.join(numbers)}]"


def text_remedy(value: Any) -> str:
    """How a number or a truth value is written where text is wanted."""
    if value is None or isinstance(value, (list, dict)):
        return ""
    return f'put it in quotes: "{shown(value)}"'


def truth_remedy(text: str) -> str:
    """What to write for the yes and no of YAML 1.1."""
    word = {"yes": "true", "on": "true", "no": "false", "off": "false"}.get(text.lower())
    return f"write {word}" if word else ""
