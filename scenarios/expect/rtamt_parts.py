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
    from rtamt.antlr.parser.stl.StlParser import StlParser
    from rtamt.semantics.interval.interval import Interval
    from rtamt.semantics.stl.discrete_time.offline.ast_visitor import (
        StlDiscreteTimeOfflineAstVisitor,
    )
    from rtamt.syntax.ast.parser.abstract_ast_parser import ast_factory
    from rtamt.syntax.ast.parser.stl.parser_visitor import StlAstParserVisitor
    from rtamt.syntax.node.abstract_node import AbstractNode
    from rtamt.syntax.node.binary_node import BinaryNode
    from rtamt.syntax.node.ltl.always import Always
    from rtamt.syntax.node.ltl.disjunction import Disjunction
    from rtamt.syntax.node.ltl.until import Until
    from rtamt.syntax.node.unary_node import UnaryNode

__all__ = [
    "AbstractNode",
    "Always",
    "BinaryNode",
    "Disjunction",
    "ErrorListener",
    "InputStream",
    "Interval",
    "LtlLexer",
    "StlAstParserVisitor",
    "StlDiscreteTimeOfflineAstVisitor",
    "StlParser",
    "UnaryNode",
    "Until",
    "ast_factory",
]
