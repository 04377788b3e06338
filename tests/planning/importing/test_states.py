"""What is valid and what holds after a course of actions is what the framework's simulator says."""

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from planning_problems import problems
from unified_planning.engines.sequential_simulator import UPSequentialSimulator
from unified_planning.model.fluent import get_all_fluent_exp

from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Variable
from casper.planning import import_problem
from casper.planning.importing.vocabulary import Vocabulary
from casper.planning.importing.wording import thing

STEPS, ASKED = 3, 8


def statements(problem):
    """Every ground action as the framework's, and as a statement."""
    vocabulary = Vocabulary(problem)
    for action in problem.actions:
        for things in product(*(list(problem.objects(p.type)) for p in action.parameters)):
            yield action, things, vocabulary.statement(action, [each.name for each in things], "human")


def values(problem, kb, history):
    """What changes, as the knowledge base has it: expression -> value, or the values where there is not just one."""
    solver, facts, value = kb.solver(history=history), Vocabulary(problem).facts, Variable("Value")
    for fluent in problem.fluents:
        for expression in get_all_fluent_exp(problem, fluent) if fluent.name not in facts else ():
            known = thing(fluent.name, [argument.object().name for argument in expression.args])
            if fluent.type.is_bool_type():
                yield expression, bool(list(solver.rows([Literal(Compound(("holds", known, "now")))], [])))
            else:
                asked = Literal(Compound(("value", known, value, "now")))
                found = {row[0] for row, _ in solver.rows([asked], [value])}
                yield expression, found.pop() if len(found) == 1 else found


def plain(value):
    return value.object().name if value.is_object_exp() else value.constant_value()


def follow(problem, choose, steps):
    """A course of the problem in both, compared at every step."""
    kb = import_problem(problem).domain().kb
    everything = list(statements(problem))
    with UPSequentialSimulator(problem, error_on_failed_checks=False) as simulator:
        state, history = simulator.get_initial_state(), []
        for time in range(steps):
            assert {e: plain(state.get_value(e)) for e, _ in values(problem, kb, history)} == dict(values(problem, kb, history))
            able = []
            for action, things, statement in choose(everything, ASKED):
                can = simulator.is_applicable(state, action, things)
                assert kb.verify(statement, history).valid is can, (statement, history)
                if can:
                    able.append((action, things, statement))
            if not able:
                return
            ((action, things, statement),) = choose(able, 1)
            state = simulator.apply(state, action, things)
            history.append((statement, float(time)))


@settings(max_examples=settings.default.max_examples // 10)
@given(problems(), st.data())
def test_a_made_up_problem_means_what_the_simulator_does(problem, data):
    def choose(what, count):
        return data.draw(st.permutations(what))[:count] if len(what) > count else what

    follow(problem, choose, STEPS)


@pytest.mark.parametrize("name", ["basic_conditional", "counter", "robot_decrease", "robot_fluent_of_user_type", "charge_discharge"])
def test_an_example_of_the_framework_means_what_the_simulator_does(examples, name):
    follow(examples[name].problem, lambda what, count: what[:count], 6)
