"""Stages one behind the other, as experiments name them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from .findings import Findings, Place, in_quotes, nearest
from .tree import Value
from .values import Parameter, expect_list, expect_map, read_values, required

#: What a recipe gives a stage beside its parameters.
_ISOLATION = ["isolate", "time_limit", "memory_limit"]

LOADER, FILTER, SPHERIZER = "mesh loader", "mesh filter", "spherizer"


@dataclass(frozen=True)
class Call:
    """A stage with the parameters that are given."""

    stage: str
    kind: str
    given: dict[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        texts = ", ".join(f"{name}: {_text(value)}" for name, value in sorted(self.given.items()))
        return f"{self.stage} ({texts})" if texts else self.stage


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:g}" if isinstance(value, float) else str(value)


@dataclass
class Chain:
    """A mesh loader or none, mesh filters, a spherizer or none; at least one stage."""

    calls: list[Call]
    label: str = ""  #: "repair.auto + spherize.grid"

    @property
    def loader(self) -> Call | None:
        """The mesh loader."""
        return next((call for call in self.calls if call.kind == LOADER), None)

    @property
    def filters(self) -> list[Call]:
        """The mesh filters."""
        return [call for call in self.calls if call.kind == FILTER]

    @property
    def spherizer(self) -> Call | None:
        """The spherizer."""
        return next((call for call in self.calls if call.kind == SPHERIZER), None)

    @property
    def names(self) -> set[str]:
        """The names of the stages."""
        return {call.stage for call in self.calls}

    def of_recipe(self) -> list[Any]:
        """Return the value of the key `stages` of a recipe."""
        return [{call.stage: call.given} for call in self.calls]


class Rule(NamedTuple):
    """Which kinds of stages a list may hold."""

    kinds: Sequence[str]
    wanted: str  #: in words


FILTERS = Rule((FILTER,), "mesh filters")
METHODS = Rule((FILTER, SPHERIZER), "mesh filters and spherizers")
METHOD = Rule((FILTER, SPHERIZER), "mesh filters and a spherizer")
ALL = Rule((LOADER, FILTER, SPHERIZER), "mesh loaders, mesh filters and spherizers")


class Reader:
    """Reads stages and checks them against those that foam has."""

    def __init__(self, known: Mapping[str, Mapping[str, Any]], findings: Findings) -> None:
        self.known = known
        self.findings = findings

    def chain(self, value: Value, name: str, rule: Rule) -> Chain | None:
        """Return a stage "repair.auto", {repair.auto: {…}}, or a list of such. None after a finding. `name`: the key."""
        if value.kind == "list" and not value.items:
            self.findings.error(value.where, "wrong-type", f"an item of '{name}' is an empty list")
            return None
        chain, good = Chain([]), True
        for item in value.as_list():
            good = self._add(item, name, rule, chain) and good
        chain.label = _label(chain, False)
        return chain if good else None

    def chains(self, value: Value, name: str, rule: Rule) -> list[Chain]:
        """Return a list of chains. Where the stages alone do not tell them apart, labels name the parameters."""
        chains: list[Chain] = []
        if not expect_list(value, name, f"{name}: [STAGE, …]", self.findings):
            return chains
        if not value.items:
            self.findings.error(value.where, "wrong-type", f"'{name}' expects at least one stage")
        for item in value.items:
            chain = self.chain(item, name, rule)
            if chain is None:
                continue
            whole = _label(chain, True)
            if any(_label(other, True) == whole for other in chains):
                self.findings.error(
                    item.where, "duplicate-value", f"{in_quotes(whole)} is in '{name}' twice; remedy: delete one"
                )
            chains.append(chain)
        labels = Counter(chain.label for chain in chains)
        for chain in chains:
            chain.label = _label(chain, labels[chain.label] > 1)
        return chains

    def method(self, root: Value, must: bool = True) -> Chain | None:
        """Return the key `method`: mesh filters and a spherizer; None after a finding."""
        given = required(root, "method", "method: spherize.medial", self.findings) if must else root.find("method")
        chain = None if given is None else self.chain(given, "method", METHOD)
        if given is not None and chain is not None and chain.spherizer is None:
            self.findings.error(
                given.where, "missing-stage", "'method' has no spherizer; remedy: add one as its last stage"
            )
        return chain

    def methods(self, root: Value, example: str) -> list[Chain]:
        """Return the key `methods`, which must be there; a finding for each method without a spherizer."""
        value = required(root, "methods", example, self.findings)
        chains = [] if value is None else self.chains(value, "methods", METHODS)
        for chain in chains:
            if value is not None and chain.spherizer is None:
                self.findings.error(
                    value.where, "missing-stage",
                    f"the method {in_quotes(chain.label)} has no spherizer; remedy: add one as its last stage",
                )  # fmt: skip
        return chains

    def filters(self, value: Value | None, name: str) -> list[Call]:
        """Return mesh filters; none where there is no value."""
        chain = None if value is None else self.chain(value, name, FILTERS)
        return [] if chain is None else chain.calls

    def call(self, value: Value, name: str) -> tuple[Call, Place, bool] | None:
        """Return a stage that foam has, its place, and whether it is to run in a process of its own."""
        if value.kind == "text":
            stage, where, parameters = value.text, value.where, None
        elif value.kind == "map" and len(value.keys) == 1:
            stage, where, parameters = value.keys[0].text, value.keys[0].where, value.items[0]
        else:
            self.findings.error(
                value.where, "wrong-type",
                f"an item of '{name}' is one stage, got {value.description}; "
                "remedy: write one '- stage: {parameter: value}' an item",
            )  # fmt: skip
            return None
        if stage not in self.known:
            near = nearest(stage, self.known)
            remedy = f"; did you mean {in_quotes(near)}?" if near else (
                "; remedy: `foam stages` lists all, `foam plugins --why` says which plugins were not loaded")  # fmt: skip
            self.findings.error(where, "unknown-stage", f"unknown stage {in_quotes(stage)}{remedy}")
            return None
        given, isolated = {}, False
        if parameters is not None and parameters.kind != "null":
            if expect_map(parameters, stage, f"{stage}: {{parameter: value}}", self.findings):
                declared = [Parameter.of_stage(parameter) for parameter in self.known[stage]["parameters"]]
                given = read_values(parameters, declared, stage, _ISOLATION, self.findings)
                isolated = any(key.text in _ISOLATION and key.text not in given for key in parameters.keys)
        return Call(stage, self.known[stage]["kind"], given), where, isolated

    def _add(self, value: Value, name: str, rule: Rule, chain: Chain) -> bool:
        """Add a stage to the chain; False after a finding."""
        read = self.call(value, name)
        if read is None:
            return False
        call, where, isolated = read

        def refuse(code: str, why: str) -> bool:
            self.findings.error(where, code, f"{in_quotes(call.stage)} {why}")
            return False

        if isolated:
            return refuse("unsupported", "is measured in this process; remedy: delete isolate, time_limit, memory_limit")
        if call.kind not in rule.kinds:
            return refuse("wrong-kind", f"is a {call.kind}; '{name}' holds {rule.wanted}")
        if chain.spherizer is not None:
            return refuse(
                "wrong-kind", f"stands behind the spherizer '{chain.spherizer.stage}'; remedy: move it before that"
            )
        if call.kind == LOADER and chain.calls:
            return refuse("wrong-kind", "is a mesh loader behind another stage; remedy: make it the first")
        chain.calls.append(call)
        return True


def _label(chain: Chain, parameters: bool) -> str:
    return " + ".join(str(call) if parameters else call.stage for call in chain.calls)
