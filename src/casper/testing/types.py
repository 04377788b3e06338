"""What ``st.from_type`` makes of our types, registered when hypothesis starts (an entry point of its own)."""

from __future__ import annotations


def register() -> None:
    """Tell hypothesis how to make terms, libraries, observations and world states."""
    from hypothesis import strategies as st

    from casper.engine.perception.world import AgentState, ObjectState, WorldState
    from casper.engine.verification.observation import Observation
    from casper.kb.terms.terms import Compound
    from casper.plans.library import PlanLibrary

    names = st.sampled_from(["a", "b", "cup", "pot"])
    values = st.one_of(names, st.integers(-3, 3))
    metres = st.integers(-50, 50).map(lambda tenths: tenths / 10)

    def compounds() -> st.SearchStrategy[Compound]:
        return st.builds(lambda name, args: Compound((name, *args)), names, st.lists(values, max_size=3))

    def libraries(_: type) -> st.SearchStrategy[PlanLibrary]:
        from casper.testing.strategies.libraries import libraries as made

        return made()

    st.register_type_strategy(Compound, compounds())
    st.register_type_strategy(PlanLibrary, libraries)
    st.register_type_strategy(Observation, st.builds(Observation, names, st.none() | st.tuples(values)))
    st.register_type_strategy(AgentState, st.builds(AgentState, metres, metres, metres, st.none() | names))
    st.register_type_strategy(ObjectState, st.builds(ObjectState, metres, metres, st.none() | metres))
    st.register_type_strategy(
        WorldState,
        st.builds(
            WorldState,
            st.integers(0, 1000).map(lambda halves: halves / 2),
            st.dictionaries(st.just("human"), st.from_type(AgentState)),
            st.dictionaries(names, st.from_type(ObjectState)),
        ),
    )
