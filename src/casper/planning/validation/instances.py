"""Actions of a plan as instances of the problem's own: those of a copy, and those that a compiler grounded.

Grounding compilers name an action after the lifted one and its arguments, ``move_l1_l2``; their plans are about actions
that "are not in the problem" for everybody else.
"""

from __future__ import annotations

from collections.abc import Iterator

from unified_planning.model import Action, Problem, Type
from unified_planning.plans import ActionInstance

from casper.kb.errors import CasperError


def own_instance(problem: Problem, instance: ActionInstance) -> ActionInstance:
    """The instance with the problem's own action.

    Raises:
        CasperError: the problem has no such action, or the name may mean two.
    """
    action = instance.action
    known = {one.name: one for one in problem.actions}
    if known.get(action.name) == action:
        return instance
    if action.name in known:
        return _of_the_same_name(known[action.name], instance)
    found = [] if instance.actual_parameters else list(dict.fromkeys(_readings(problem, action.name)))
    if not found:
        raise CasperError(f"the problem has no action {action.name}; it has {', '.join(sorted(known)) or 'none'}")
    if len(found) > 1:
        shown = " or ".join(f"{name}({', '.join(arguments)})" for name, arguments in found)
        raise CasperError(f"the action {action.name} may be {shown}: use names that can be told apart")
    name, arguments = found[0]
    manager = problem.environment.expression_manager
    return ActionInstance(known[name], tuple(manager.ObjectExp(problem.object(each)) for each in arguments))


def _of_the_same_name(own: Action, instance: ActionInstance) -> ActionInstance:
    """An action of a copy of the problem."""
    given, wanted = list(instance.action.parameters), list(own.parameters)
    if [parameter.type for parameter in given] != [parameter.type for parameter in wanted]:
        shown = ", ".join(f"{parameter.name} - {parameter.type}" for parameter in wanted)
        raise CasperError(f"{own.name} of the plan is another action than the problem's {own.name}({shown})")
    return ActionInstance(own, instance.actual_parameters)


def _readings(problem: Problem, name: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Every lifted action with arguments that the name may stand for."""
    for action in problem.actions:
        if action.parameters and name.startswith(f"{action.name}_"):
            rest = name[len(action.name) + 1 :]
            for arguments in _split(problem, rest, [parameter.type for parameter in action.parameters]):
                yield action.name, arguments


def _split(problem: Problem, text: str, types: list[Type]) -> Iterator[tuple[str, ...]]:
    """The text as names of objects of these types, with underscores between them."""
    if not types[0].is_user_type():
        return
    for thing in problem.objects(types[0]):
        if len(types) == 1:
            if text == thing.name:
                yield (thing.name,)
        elif text.startswith(f"{thing.name}_"):
            for others in _split(problem, text[len(thing.name) + 1 :], types[1:]):
                yield (thing.name, *others)
