"""What xacro or roslaunch should have expanded and did not: recognised, with the cure. Pure."""

from __future__ import annotations

import re
from xml.etree import ElementTree

_SUBSTITUTION = re.compile(r"\$[({]")
_OLD_TAGS = ("include", "macro", "property")
"""What xacro's elements were called before they had a namespace; URDF has none of these."""
_CURE = "expand the file first: xacro in.xacro > out.urdf"


def substitution(text: str | None) -> str:
    """Return why a text is no value but a substitution, with the cure; empty if it is none.

    Parameters
    ----------
    text : str or None
        Of an attribute: ``$(find pkg)/a.stl``, ``${width / 2}``.
    """
    if text is None or not _SUBSTITUTION.search(text):
        return ""
    return f"this is a substitution of xacro or roslaunch; {_CURE}"


def macro(root: ElementTree.Element) -> str:
    """Return which element of a robot is one of xacro's, with the cure; empty if none is."""
    for element in root.iter():
        address, _, tag = str(element.tag).rpartition("}")
        if "xacro" in address or (element.tag in _OLD_TAGS and element in list(root)):
            return f"<{'xacro:' if address else ''}{tag}> is a macro of xacro; {_CURE}"
    return ""


def undeclared(text: bytes) -> str:
    """Return whether what is no XML may be so for want of xacro's namespace, with the cure."""
    return f"it holds macros of xacro; {_CURE}" if b"<xacro:" in text else ""
