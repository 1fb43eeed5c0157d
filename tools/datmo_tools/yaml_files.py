# SPDX-License-Identifier: BSD-3-Clause
"""Reads untrusted yaml within the bounds of src/ros/bounded_yaml.cpp, with the same messages."""

from pathlib import Path

import yaml

from datmo_tools.errors import InputError

MAX_BYTES = 1 << 20
MAX_DEPTH = 100
MAX_NODES = 100_000  # an alias counts as many as what it stands for
# Characters, here only: PyYAML's time for a sexagesimal number (1:30:00) grows with their square.
MAX_NUMBER = 1000
# What PyYAML raises for a value that does not match its tag (!!bool x): it has no error of its own
# for these.
BAD_VALUES = (ValueError, LookupError, AttributeError, TypeError, ArithmeticError)


class _Loader(yaml.SafeLoader):
    """A loader that rejects numbers that are too long."""


def _number(construct):
    """Wraps a number constructor of PyYAML with a bound on the number's length."""
    def bounded(loader, node):
        if len(loader.construct_scalar(node)) > MAX_NUMBER:
            said = f"a number has more than {MAX_NUMBER} characters"
            raise yaml.constructor.ConstructorError(problem=said, problem_mark=node.start_mark)
        return construct(loader, node)

    return bounded


for _kind in ("int", "float"):
    _tag = f"tag:yaml.org,2002:{_kind}"
    _Loader.add_constructor(_tag, _number(yaml.SafeLoader.yaml_constructors[_tag]))


def load_yaml(file):
    """Returns a yaml file's content: a dictionary, a list, a value or None. Raises InputError."""
    try:
        with Path(file).open("rb") as stream:
            text = stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise InputError(f"{file}: expected a yaml file that can be read ({error})") from error
    if len(text) > MAX_BYTES:
        raise InputError(f"{file}: expected yaml, but it has more than {MAX_BYTES} bytes")
    return parse_yaml(file, text)


def parse_yaml(name, text):
    """Returns the content of a text (str or bytes); `name` is for messages. Raises InputError."""
    try:
        _check_size(name, text)
        return yaml.load(text, _Loader)
    except yaml.YAMLError as error:
        raise InputError(f"{name}: expected yaml, but {error}") from error
    except BAD_VALUES as error:  # a date that does not exist, bytes that are not text
        raise InputError(f"{name}: expected yaml, but a value is not what its tag or form says ({error!r})") from error


def _check_size(name, text):
    """Checks the parser's events, so that what exceeds the bounds is never built."""
    nodes, opened, nodes_of = 0, [], {}
    for event in yaml.parse(text, yaml.SafeLoader):
        where = f"{name}:{event.start_mark.line + 1}: expected yaml, but"
        if isinstance(event, yaml.AliasEvent):
            if event.anchor in nodes_of and nodes_of[event.anchor] is None:
                raise InputError(f"{where} an alias stands for what it stands in")
            nodes += nodes_of.get(event.anchor, 0)  # the loader rejects unknown aliases
        elif isinstance(event, yaml.NodeEvent):
            is_leaf = isinstance(event, yaml.ScalarEvent)
            nodes_of[event.anchor] = 1 if is_leaf else None  # known when it ends
            if not is_leaf:
                opened.append((event.anchor, nodes))
            nodes += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            anchor, before = opened.pop()
            nodes_of[anchor] = nodes - before
        if len(opened) > MAX_DEPTH:
            raise InputError(f"{where} lists and maps are nested more than {MAX_DEPTH} deep")
        if nodes > MAX_NODES:
            raise InputError(f"{where} there are more than {MAX_NODES} values, including those of aliases")
