"""Hearing returns is invisible to the functions heard, and to other tools."""

from __future__ import annotations

import inspect
import sys
import threading
import traceback

import pytest

from aegis_ot.instrumentation.own_functions import own_functions
from aegis_ot.instrumentation.returns import heard_returns
from aegis_ot.instrumentation.rewritten import rewritten

TEXT = """
def plain(x):
    "What it does."
    y = x + 1
    return y

def failing(x):
    z = x
    try:
        return fails(z)
    finally:
        z = "after"

def fails(z):
    return z + [1][3]

def early(x):
    for y in x:
        if y == 2:
            return [w for w in x]

def outer(x):
    def inner():
        nonlocal x
        x += 1
    inner()
    return x

def generator(n):
    for i in range(n):
        yield i

class Thing:
    def method(self):
        me = super().__repr__()
        return __class__
"""
NEW = sys.version_info >= (3, 12)
WAYS = [heard_returns] if NEW else [heard_returns, rewritten]


def loaded(text=TEXT):
    namespace = {"__name__": "builtins"}
    exec(compile(text, "protocol.py", "exec"), namespace)
    return namespace


def heard(namespace, call, way=heard_returns, text=TEXT):
    looks = []

    def look(frame):
        looks.append((frame.f_code.co_name, dict(frame.f_locals)))

    functions = own_functions(namespace, {"protocol.py"})
    with way(functions, lambda _: text, look):
        result = call()
    return result, looks


@pytest.mark.parametrize("way", WAYS)
def test_each_return_is_told_with_the_last_values(way):
    names = loaded()
    result, looks = heard(names, lambda: names["early"]([1, 2, 3]), way)
    assert result == [1, 2, 3]
    told, values = looks[-1]
    assert (told, values["y"]) == ("early", 2)
    result, looks = heard(names, lambda: names["outer"](1), way)
    assert (result, [name for name, _ in looks]) == (2, ["inner", "outer"])
    result, looks = heard(names, lambda: list(names["generator"](3)), way)
    assert result == [0, 1, 2]
    assert looks[-1] == ("generator", {"n": 3, "i": 2})
    result, looks = heard(names, names["Thing"]().method, way)
    assert result is names["Thing"]
    assert looks[-1][0] == "method"


@pytest.mark.parametrize("way", WAYS)
def test_errors_look_the_same(way):
    def shown():
        try:
            names["failing"](1)
        except IndexError as error:
            return traceback.format_exception(error)
        raise AssertionError("it does not fail")

    names = loaded()
    plain = shown()
    assert heard(names, shown, way)[0] == plain


@pytest.mark.parametrize("way", WAYS)
def test_functions_look_the_same_and_are_given_back(way):
    names = loaded()
    codes = {name: f.__code__ for name, f in names.items() if inspect.isfunction(f)}

    def look_at():
        function = names["plain"]
        return (function.__doc__, inspect.signature(function), function.__code__.co_firstlineno,
                function.__code__.co_names, function.__code__.co_varnames)  # fmt: skip

    assert heard(names, look_at, way)[0][:3] == look_at()[:3]
    assert {name: f.__code__ for name, f in names.items() if inspect.isfunction(f)} == codes
    with pytest.raises(IndexError):
        heard(names, lambda: names["failing"](1), way)
    assert all(names[name].__code__ is code for name, code in codes.items())


@pytest.mark.parametrize("way", WAYS)
def test_two_threads_that_share_a_module_hear_each_its_own_calls(way):
    """Two analyses of a robot server, say: the second used to hear nothing."""
    names = loaded()
    code = names["plain"].__code__
    inside, first_is_over = threading.Event(), threading.Event()
    looks = {}

    def first():
        def call():
            inside.set()
            assert second_called.wait(10)
            names["plain"](1)

        _, looks["first"] = heard(names, call, way)
        first_is_over.set()

    def second():
        def call():
            names["plain"](2)
            second_called.set()
            assert first_is_over.wait(10)
            names["plain"](3)

        assert inside.wait(10)
        _, looks["second"] = heard(names, call, way)

    second_called = threading.Event()
    threads = [threading.Thread(target=first), threading.Thread(target=second)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(20)
    assert [values["x"] for _, values in looks["first"]] == [1]
    assert [values["x"] for _, values in looks["second"]] == [2, 3]
    assert names["plain"].__code__ is code


@pytest.mark.parametrize("way", WAYS)
def test_functions_of_two_files_that_look_alike_stay_in_their_files(way):
    one, other = loaded(), {"__name__": "builtins"}
    exec(compile(TEXT, "helper.py", "exec"), other)
    files = []
    with way(
        own_functions(one | {"other": other["plain"]}, {"protocol.py", "helper.py"}),
        lambda _: TEXT,
        lambda frame: files.append(frame.f_code.co_filename),
    ):
        one["plain"](1)
        other["plain"](1)
    assert files == ["protocol.py", "helper.py"]


def test_a_function_that_outlives_the_run_is_not_heard_any_more():
    names = loaded("def make():\n    def kept():\n        x = 1\n    return kept\n")
    text = "def make():\n    def kept():\n        x = 1\n    return kept\n"
    kept, looks = heard(names, names["make"], text=text)
    del looks[:]
    kept()
    assert looks == []


@pytest.mark.skipif(NEW, reason="from Python 3.12 on no text is needed")
@pytest.mark.parametrize("text", ["", "def plain(x):\n    return x\n", "def plain(x"])
def test_code_that_is_not_of_the_text_is_left_alone(text):
    names = loaded()
    result, looks = heard(names, lambda: names["plain"](1), text=text)
    assert (result, looks) == (2, [])


def test_a_debuggers_trace_sees_what_it_saw():
    names = loaded()
    lines = []

    def tracer(frame, event, _argument):
        if frame.f_code.co_filename == "protocol.py":
            lines.append((frame.f_code.co_name, event, frame.f_lineno))
        return tracer

    def traced():
        del lines[:]
        names["early"]([1, 2])
        return list(lines)

    before = sys.gettrace()
    sys.settrace(tracer)
    try:
        plain = traced()
        result, looks = heard(names, traced)
    finally:
        sys.settrace(before)
    assert result == plain
    assert "early" in [name for name, _ in looks]


def test_a_profiler_is_left_in_peace():
    names = loaded()
    seen = []
    before = sys.getprofile()
    sys.setprofile(lambda frame, event, _: seen.append((frame.f_code.co_name, event)))
    try:
        heard(names, lambda: names["plain"](1))
    finally:
        sys.setprofile(before)
    assert ("plain", "call") in seen
    assert ("plain", "return") in seen


@pytest.mark.skipif(not NEW, reason="sys.monitoring is new in Python 3.12")
def test_two_at_once_and_then_a_third():
    names = loaded()
    result, looks = heard(
        names, lambda: heard(names, lambda: heard(names, lambda: names["plain"](1)))
    )
    assert [name for name, _ in looks] == ["plain"]
    (inner, (innermost, third)) = result[1], result[0]
    assert [name for name, _ in inner] == ["plain"]
    assert [name for name, _ in third] == ["plain"]
    assert innermost == 2
    assert [sys.monitoring.get_tool(tool) for tool in (3, 4)] == [None, None]
    assert sys.getprofile() is None
