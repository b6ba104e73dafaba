"""The parts of rtamt that are used here, imported quietly and in one place.

rtamt and its parser generator are not typed, and the latter warns on import that it uses a
deprecated module of Python's.
"""

from __future__ import annotations

import warnings

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)
    from antlr4 import InputStream  # type: ignore[import-untyped]
    from antlr4.error.ErrorListener import ErrorListener  # type: ignore[import-untyped]
    from rtamt.antlr.parser.stl.LtlLexer import LtlLexer
    from rtamt.semantics.interval.interval import Interval
    from rtamt.semantics.stl.discrete_time.offline.ast_visitor import (
        StlDiscreteTimeOfflineAstVisitor,
    )
    from rtamt.syntax.ast.parser.stl.specification_parser import (
        StlAst,
    )

__all__ = [
    "ErrorListener",
    "InputStream",
    "Interval",
    "LtlLexer",
    "StlAst",
    "StlDiscreteTimeOfflineAstVisitor",
]
