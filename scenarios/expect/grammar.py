"""From text to rtamt's syntax tree: its grammar, three words more, and its faults mended.

What is mended, each with a test that shows the fault is still there:

- rtamt adds the children of an addition and of ``not`` twice, and its evaluation takes one or two.
- Its ``unless`` looks from a bound that is no fraction, and is not read without bounds.
- It reads ``x - y + z`` as x - (y + z), and ``x / y * z`` as x / (y * z): refused here.
"""

from __future__ import annotations

from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import Any

from .rtamt_parts import (
    AbstractNode,
    Always,
    BinaryNode,
    Disjunction,
    ErrorListener,
    InputStream,
    LtlLexer,
    StlAstParserVisitor,
    StlParser,
    UnaryNode,
    Until,
    ast_factory,
)

Node = Any
"""A node of rtamt's syntax tree; rtamt is not typed."""

CALLED_LIKE = {"rate": StlParser.ABS, "min": StlParser.POW, "max": StlParser.POW}
"""What is called here and unknown to rtamt, by the function of its grammar with as many values."""
_DECLARING = {
    *range(StlParser.ROS_Topic, StlParser.NotOperator),
    StlParser.AT,
    StlParser.DOT,
    StlParser.SEMICOLON,
}
"""Words of rtamt's that declare, import and annotate."""
_LARGEST = 300
"""Largest power of ten of a number; a fraction of 1e999999999 fills any memory."""
_SHOWN = 40
_DEEPEST = 60
"""Operators within one another; each takes a few frames of Python's stack when it is judged."""
_MOST_UNLESS = 6
"""``unless`` in a formula: each holds what stands before it twice."""


class FormulaError(ValueError):
    """A formula cannot be understood; the message is one line and says what would be right."""


class Rate(UnaryNode):  # type: ignore[misc]
    """The derivative of a number by time, per second."""


class Minimum(BinaryNode):  # type: ignore[misc]
    """The smaller of two numbers."""


class Maximum(BinaryNode):  # type: ignore[misc]
    """The larger of two numbers."""


class _Listener(ErrorListener):  # type: ignore[misc]
    """Raises what ANTLR would print."""

    def syntaxError(
        self, recognizer: Any, symbol: Any, line: int, column: int, message: str, error: Any
    ) -> None:
        text = getattr(symbol, "text", None) or message.rpartition("at: ")[2].strip("'")
        if text == "<EOF>":
            raise FormulaError("the formula ends too early; is a bracket or a value missing?")
        hint = f"; write (0 - {text})" if _text_before(recognizer, symbol) == "-" else ""
        if isinstance(context := getattr(recognizer, "_ctx", None), StlParser.ExprPowContext):
            name = context.POW().getText()
            hint = f"; {name} takes two numbers: {name}(x, y)"
        raise FormulaError(f"{text!r} at character {column + 1} cannot stand there{hint}")


def _text_before(parser: Any, symbol: Any) -> str:
    """Return the text of the token before one that cannot be parsed; empty in the lexer."""
    if symbol is None or symbol.tokenIndex == 0:
        return ""
    return str(parser.getTokenStream().get(symbol.tokenIndex - 1).text)


class _Lexer(LtlLexer):  # type: ignore[misc]
    """rtamt's words, and `CALLED_LIKE` where a bracket follows."""

    def __init__(self, stream: Any) -> None:
        super().__init__(stream)
        self._listeners = [_Listener()]

    def nextToken(self) -> Any:
        token = super().nextToken()
        if token.type == StlParser.Identifier and token.text in CALLED_LIKE and self._called():
            token.type = CALLED_LIKE[token.text]
        return token

    def _called(self) -> bool:
        ahead = 1
        while chr(max(self._input.LA(ahead), 0)).isspace():
            ahead += 1
        return bool(self._input.LA(ahead) == ord("("))


def tokens(text: str) -> list[Any]:
    """Return the words of a formula; what declares, imports or annotates is none.

    Raises
    ------
    FormulaError
        If it holds what is no word of a formula.
    """
    found: list[Any] = _Lexer(InputStream(text)).getAllTokens()
    for token in found:
        if token.type == StlParser.EQUAL:
            raise FormulaError("'=' says nothing here; write == to compare")
        # rtamt would import Python modules that a formula names.
        if token.type in _DECLARING:
            raise FormulaError(f"{token.text!r} at character {token.column + 1} cannot stand there")
        if token.type in (StlParser.IntegerLiteral, StlParser.RealLiteral):
            _require_number(token.text)
    if sum(token.type == StlParser.UnlessOperator for token in found) > _MOST_UNLESS:
        raise FormulaError(f"it holds 'unless' more than {_MOST_UNLESS} times; part it in several")
    return found


def _require_number(text: str) -> None:
    try:
        size = abs(Decimal(text).adjusted())
    except InvalidOperation as error:
        raise FormulaError(f"{text[:_SHOWN]} is no decimal number") from error
    if size > _LARGEST:
        text = f"{text[:_SHOWN]}{'...' * bool(text[_SHOWN:])}"
        raise FormulaError(f"{text} is out of reach: between 1e-{_LARGEST} and 1e{_LARGEST}")


def tree(text: str, names: tuple[str, ...]) -> Node:
    """Return the root of the syntax tree of a formula over columns; nodes have their ``text``.

    Raises
    ------
    FormulaError
        If it cannot be read.
    """
    ast = ast_factory(_TreeMaker)(_Lexer, StlParser, _Listener)
    for name in names:
        ast.declare_var(name, "float")
    ast.spec = text
    try:
        ast.parse()
    except FormulaError:
        raise
    except RecursionError as error:
        raise FormulaError("it is nested too deeply") from error
    except Exception as error:  # rtamt fails in its own ways
        raise FormulaError(f"rtamt cannot read this ({' '.join(str(error).split())})") from error
    if len(ast.specs) != 1:
        raise FormulaError("this is more than one formula; join them with and")
    if _depth(ast.specs[0]) > _DEEPEST:
        raise FormulaError("it is nested too deeply")
    return ast.specs[0]


def _depth(node: Node) -> int:
    return 1 + max(map(_depth, node.children), default=0)


class _TreeMaker(StlAstParserVisitor):  # type: ignore[misc]
    """rtamt's way from the grammar's tree to its own, mended."""

    def visit(self, context: Any) -> Any:
        made = super().visit(context)
        if isinstance(made, UnaryNode | BinaryNode):
            del made.children[1 if isinstance(made, UnaryNode) else 2 :]  # some are there twice
        if isinstance(made, AbstractNode) and not hasattr(made, "text"):
            made.text = _text(context)
        return made

    def visitExprSubtraction(self, context: Any) -> Node:
        _require_brackets(context, 1, StlParser.ExprAdditionContext, "-", "+")
        return super().visitExprSubtraction(context)

    def visitExprDivision(self, context: Any) -> Node:
        _require_brackets(context, 1, StlParser.ExprMultiplicationContext, "/", "*")
        return super().visitExprDivision(context)

    def visitExprImplies(self, context: Any) -> Node:
        _require_brackets(context, 0, StlParser.ExprImpliesContext, "implies", "implies")
        return super().visitExprImplies(context)

    def visitExprUnless(self, context: Any) -> Node:
        if context.interval() is None:
            held, until = (self.visit(each) for each in context.expression())
            node = Disjunction(Always(held), Until(held, until))
        else:
            node = super().visitExprUnless(context)
            node.children[0].begin = Fraction(0)
        for alternative in node.children:
            alternative.text = _text(context)
        return node

    def visitExprAbs(self, context: Any) -> Node:
        if context.ABS().getText() == "rate":
            return Rate(self.visit(context.expression()))
        return super().visitExprAbs(context)

    def visitExprPow(self, context: Any) -> Node:
        made = {"min": Minimum, "max": Maximum}.get(context.POW().getText())
        if made is not None:
            return made(*(self.visit(each) for each in context.expression()))
        return super().visitExprPow(context)


def _text(context: Any) -> str:
    whole = context.start.getInputStream().getText(context.start.start, context.stop.stop)
    return str(whole).replace("!==", "!=")


def _require_brackets(context: Any, place: int, kind: type, first: str, second: str) -> None:
    """Require brackets where rtamt reads a row of two operators from its end, or as few do."""
    operand = context.expression(place)
    if isinstance(operand, kind):
        raise FormulaError(
            f"brackets must say what {_text(context)} means: which comes first, {first} or {second}"
            if first != second
            else f"brackets must say what {_text(context)} means: which {first} comes first"
        )
