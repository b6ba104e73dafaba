"""One colour a link: the engine's window gives all shapes of a link the colour of one. Pure."""

from __future__ import annotations

from itertools import groupby
from xml.etree import ElementTree


def one_colour_a_link(urdf: str) -> str:
    """Return a URDF that looks the same and whose links each have shapes of one colour.

    Shapes of a further colour move to a massless link of their own, fixed to the first; it
    comes last, so that what exists keeps its order.

    Parameters
    ----------
    urdf : str

    Returns
    -------
    str
    """
    root = ElementTree.fromstring(urdf)
    for link in root.findall("link"):
        name = link.get("name", "")
        visuals = sorted(link.findall("visual"), key=_colour)
        groups = [list(same) for _, same in groupby(visuals, key=_colour)]
        for number, same in enumerate(groups[1:], start=2):
            extra = ElementTree.SubElement(root, "link", name=f"{name}_{number}")
            for visual in same:
                link.remove(visual)
                extra.append(visual)
            joint = ElementTree.SubElement(root, "joint", name=f"{name}_{number}", type="fixed")
            ElementTree.SubElement(joint, "parent", link=name)
            ElementTree.SubElement(joint, "child", link=f"{name}_{number}")
    return ElementTree.tostring(root, encoding="unicode")


def _colour(visual: ElementTree.Element) -> str:
    """Return what tells a shape's colour from others: its material's name or its numbers."""
    material = visual.find("material")
    if material is None:
        return ""
    colour = material.find("color")
    return material.get("name", "") if colour is None else colour.get("rgba", "")
