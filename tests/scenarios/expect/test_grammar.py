"""Every operator of rtamt's grammar is judged or refused, and its faults are mended."""

import time

import numpy as np
import pytest

from cowalk.scenarios.expect import rtamt_parts
from cowalk.scenarios.expect.grammar import FormulaError, tokens, tree
from cowalk.scenarios.expect.margin import margins
from cowalk.scenarios.expect.rtamt_parts import (
    StlAstParserVisitor,
    StlDiscreteTimeOfflineAstVisitor,
    StlParser,
    ast_factory,
)
from cowalk.scenarios.expect.verdict import explain, judge, syntax_error

PERIOD = 0.05
T = (np.arange(60) + 1) * PERIOD
COLUMNS = {"t": T, "x": T - 1.0, "y": np.sin(3.0 * T), "steps": np.floor(2.0 * T)}

OPERATORS = {
    "ExprPredicate": ["{x} >= 0.3", "{x} > 0.3", "{x} <= 0.3", "{x} < {x}", "{x} == 0", "{x} != 0"],
    "ExprId": ["x > 0"],
    "ExprLiteral": ["x > 1.5e-1", "x > -2"],
    "ExprParen": ["({p})"],
    "ExprNot": ["not {p}", "! {p}"],
    "ExprAnd": ["{p} and {q}", "{p} & {q}"],
    "ExprOr": ["{p} or {q}", "{p} | {q}"],
    "ExprImplies": ["{p} implies {q}", "{p} -> {q}"],
    "ExprIff": ["{p} iff {q}", "{p} <-> {q}"],
    "ExprXor": ["{p} xor {q}"],
    "ExprAlways": ["always {p}", "always[0:1s] {p}", "G[500ms:1s] {p}"],
    "ExprEv": ["eventually {p}", "eventually[0:1s] {p}", "F[0.5,1] {p}"],
    "ExpreOnce": ["once {p}", "once[0:1s] {p}", "O[0.5:1s] {p}"],
    "ExprHist": ["historically {p}", "historically[0:1s] {p}", "H[0.5:1s] {p}"],
    "ExprUntil": ["{p} until {q}", "{p} until[0:1s] {q}", "{p} U[0.5:1s] {q}"],
    "ExprUnless": ["{p} unless {q}", "{p} unless[0:1s] {q}", "{p} W[0.5:1s] {q}"],
    "ExprSince": ["{p} since {q}", "{p} since[0:1s] {q}", "{p} S[0.5:1s] {q}"],
    "ExprNext": ["next {p}", "X {p}"],
    "ExprStrongNext": ["s_next {p}", "sX {p}"],
    "ExprPrevious": ["prev {p}", "Y {p}"],
    "ExprStrongPrevious": ["s_prev {p}", "sY {p}"],
    "ExprRise": ["rise({p})"],
    "ExprFall": ["fall({p})"],
    "ExprAbs": ["abs({x}) > 0.5", "rate({x}) > 0.5"],
    "ExprSqrt": ["sqrt({x}) > 0.5"],
    "ExprExp": ["exp({x}) > 0.5"],
    "ExprPow": ["pow({x}, 2) > 0.5", "min({x}, y) > 0.5", "max({x}, y) > 0.5"],
    "ExprAddition": ["{x} + y > 0.5", "x + {x} + y + 1 > 0.5"],
    "ExprSubtraction": ["{x} - y > 0.5", "x - {x} - y - 1 > 0.5", "x + y - {x} > 0"],
    "ExprMultiplication": ["{x} * y > 0.5"],
    "ExprDivision": ["{x} / y > 0.5", "x * y / {x} > 0.5"],
}
"""Ways to write each expression of the grammar; {p} and {q} are formulas, {x} is a number."""

SHAPES = {
    "alone": lambda way: way.format(p="(x > 0)", q="(y > 0)", x="x"),
    "of more": lambda way: way.format(
        p="(abs(y) + 1 > 0 and not (x > 1))", q="(eventually[0:1s] (t > 1))", x="(x + 2 * t)"
    ),
    "within": lambda way: f"always ((t >= 0.5) implies ({SHAPES['alone'](way)}))",
}


def test_the_table_holds_every_expression_of_the_grammar():
    of_grammar = {
        name.removesuffix("Context")
        for name, found in vars(StlParser).items()
        if isinstance(found, type) and issubclass(found, StlParser.ExpressionContext)
    }
    assert set(OPERATORS) == of_grammar - {"Expression"}


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("way", [way for ways in OPERATORS.values() for way in ways])
def test_every_operator_is_judged(way, shape):
    formula = SHAPES[shape](way)
    assert syntax_error(formula, COLUMNS, PERIOD, 3.0) is None
    (verdict,) = judge({"it": formula}, COLUMNS, PERIOD)
    explained = verdict.reason or verdict.vacuous
    assert np.isfinite(verdict.robustness) or explained, explain(verdict)
    assert verdict.robustness >= 0.0 if verdict.passed else not verdict.robustness > 0.0
    assert "\n" not in explain(verdict)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    ("way", "words"),
    [
        ("x - {x} + y > 0", "which comes first, - or +"),
        ("x / {x} * y > 0", "which comes first, / or *"),
        ("{p} implies {q} implies {p}", "which implies comes first"),
        ("max({x}) > 0", "max takes two numbers: max(x, y)"),
        ("min({x}, y, t) > 0", "min takes two numbers: min(x, y)"),
        ("rate({p}) > 0", "true or false, not a number"),
        ("always[0:x] {p}", "Bound x not declared"),
        ("always[0:1e9s] {p}", "the bound 1e+09 s lies beyond the end of the run"),
        ("always[0:1e999999999s] {p}", "1e999999999 is out of reach"),
        ("eventually[0:1e-999999999s] {p}", "1e-999999999 is out of reach"),
        ("once[0:0x1s] {p}", "0x1 is no decimal number"),
    ],
)
def test_what_is_no_formula_is_refused_in_one_line(way, words, shape):
    message = syntax_error(SHAPES[shape](way), COLUMNS, PERIOD, 3.0)
    assert words in message
    assert "\n" not in message


@pytest.mark.parametrize(
    "formula",
    [
        "from t import x x > 0",
        "float x x > 0",
        "const float x = 3 y > 0",
        "input float x y > 0",
        "specification x y > 0",
        "@topic(x, y) y > 0",
        "x > 0; y > 0",
    ],
)
def test_a_formula_declares_and_imports_nothing(formula):
    assert syntax_error(formula, COLUMNS, PERIOD) is not None
    with pytest.raises(FormulaError):
        tokens(formula)


def test_a_formula_nested_without_end_is_refused():
    said = "it is nested too deeply"
    assert syntax_error("not " * 480 + "(x > 0)", COLUMNS, PERIOD) == said
    assert syntax_error("not " * 60 + "(x > 0)", COLUMNS, PERIOD) == said
    assert syntax_error("not " * 50 + "(x > 0)", COLUMNS, PERIOD) is None
    assert "write it in 2,000" in syntax_error("not " * 2000 + "(x > 0)", COLUMNS, PERIOD)


def test_bounds_within_the_run_look_within_it_together():
    looks = "always[2s:3s] (eventually[1s:2s] (x > 0))"
    assert syntax_error(looks, COLUMNS, PERIOD, 3.05) is None
    assert "from 3 s on, but the run is over by then" in syntax_error(looks, COLUMNS, PERIOD, 3.0)


def plain_tree(formula):
    """Return the tree that rtamt makes of a formula on its own."""
    ast = ast_factory(StlAstParserVisitor)(rtamt_parts.LtlLexer, StlParser, None)
    for name in COLUMNS:
        ast.declare_var(name, "float")
    ast.spec = formula
    ast.parse()
    return ast.specs[0]


def test_rtamt_still_adds_the_children_of_an_addition_twice():
    assert len(plain_tree("x + y > 0").children[0].children) == 4  # 2: take the mending away
    assert len(tree("x + y > 0", ("x", "y")).children[0].children) == 2


def test_rtamt_still_gives_unless_a_bound_that_is_no_fraction():
    assert isinstance(plain_tree("(x > 0) unless[0:1s] (y > 0)").children[0].begin, int)
    with pytest.raises(AttributeError):
        plain_tree("(x > 0) unless (y > 0)")


@pytest.mark.parametrize("operators", ["-+", "/*"])
def test_rtamt_still_reads_a_row_of_two_from_its_end(operators):
    first, second = operators
    left, right = plain_tree(f"x {first} y {second} t > 0").children[0].children
    assert left.name == "x"
    assert right.name == f"(y){second}(t)"


def test_until_and_since_within_bounds_are_those_of_rtamt():
    class Plain(StlDiscreteTimeOfflineAstVisitor):
        def visit(self, node, *args):
            return {"left": left, "right": right}[node]

        def time_unit_transformer(self, node):
            return bounds

    rng = np.random.default_rng(5)
    for bounds in [(0, 0), (0, 7), (2, 5), (3, 3), (4, 39), (0, 60), (41, 50)]:
        values = rng.normal(size=(2, 40))
        left, right = values.tolist()
        columns = {"a": values[0], "b": values[1]}
        for operator in ("until", "since"):
            node = tree(f"(a > 0) {operator}[{bounds[0]}:{bounds[1]}] (b > 0)", ("a", "b"))
            fake = type("Node", (), {"children": ["left", "right"]})
            plain = getattr(Plain(), f"visitTimed{operator.title()}")(fake)
            assert margins(node, columns, 1.0).tolist() == plain


def test_the_words_that_are_not_rtamts_may_still_name_columns():
    columns = {"min": T, "rate": T}
    (verdict,) = judge({"it": "always (min + rate >= max (min, rate))"}, columns, PERIOD)
    assert verdict.robustness == pytest.approx(PERIOD)


def test_nodes_have_their_text():
    root = tree("always (abs(x) !== 2)", ("x",))
    assert root.text == "always (abs(x) != 2)"
    assert root.children[0].text == "abs(x) != 2"


@pytest.mark.parametrize(
    "formula",
    [
        "not " * 40 + "(x > 0)",
        "(" * 40 + "x > 0" + " xor (x > 1))" * 40,
        "(" * 40 + "x > 0" + " unless (x > 1))" * 40,
        "(" * 7 + "x > 0" + " unless[0:1s] (x > 1))" * 7,
        "(" * 40 + "x" + " + 1)" * 40 + " > 0",
    ],
    ids=["not", "xor", "unless", "timed unless", "addition"],
)
def test_no_formula_grows_with_a_power_of_its_length(formula):
    """Rtamt's nodes of these hold some children twice: 2^40 of them would never be judged."""
    begun = time.process_time()
    reason = syntax_error(formula, COLUMNS, PERIOD)
    assert time.process_time() - begun < 2.0
    assert ("unless" in formula) == (reason is not None)
