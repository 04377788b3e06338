"""A recursive hierarchical domain in the manner of emergency response, made up: a flood, its crews and their vehicles.

12 goals, 40 tasks and 55 methods with typed parameters: to get something to a place a vehicle gets there first, for
which its driver gets to it, for which …
"""

from __future__ import annotations

from casper.engine.domain.domain import Domain

KINDS = {
    "place": "harbour market school hospital mill bridge_head church quarry depot park",
    "road": "quay_road mill_lane ring_road high_street",
    "driver": "ada bo cem dora",
    "medic": "mei noor",
    "labourer": "lou max nia otto",
    "victim": "vic vera walt wim",
    "truck": "truck1 truck2",
    "ambulance": "amb1 amb2",
    "boat": "boat1 boat2",
    "bus": "bus1 bus2",
    "pump": "pump1 pump2",
    "generator": "gen1 gen2",
    "saw": "saw1 saw2",
    "light": "light1 light2",
    "barrier": "bar1 bar2",
    "tank": "tank1 tank2",
    "digger": "digger1 digger2",
}
TYPES = """\
human(X) :- driver(X). human(X) :- medic(X). human(X) :- labourer(X).
robot(rob). agent(X) :- human(X). agent(X) :- robot(X).
person(X) :- human(X). person(X) :- victim(X).
vehicle(X) :- truck(X). vehicle(X) :- ambulance(X). vehicle(X) :- boat(X). vehicle(X) :- bus(X).
tool(X) :- pump(X). tool(X) :- generator(X). tool(X) :- saw(X). tool(X) :- light(X). tool(X) :- barrier(X).
tool(X) :- tank(X). tool(X) :- digger(X).
site(X) :- place(X). site(X) :- road(X).
"""
ACTIONS = {
    "walk": "site", "climb_in": "vehicle", "climb_out": "vehicle", "drive": "vehicle site", "load": "tool vehicle",
    "unload": "tool vehicle", "lift_in": "victim vehicle", "lift_out": "victim vehicle", "bandage": "victim",
    "splint": "victim", "start": "tool", "stop": "tool", "hose": "tool place", "saw_up": "saw road", "drag": "road",
    "tow": "truck road", "sweep": "road", "raise": "tool site", "aim": "light site", "block": "barrier site",
    "sign": "site", "refuel": "tool", "wire": "generator place", "flip": "place", "dig": "digger place",
    "weld": "place", "fill": "tank", "tap": "tank place", "radio": "site", "announce": "place", "count": "place",
    "unlock": "place", "warm": "place", "cook": "place", "blanket": "victim",
    "splice": "place", "test_line": "place", "patrol": "site", "find": "victim place", "note": "victim",
    "wash_up": "place",
}  # fmt: skip
PLANS = """\
goal(clear_wreck(R)) :- road(R).
goal(clear_tree(R)) :- road(R).
goal(fix_line(P)) :- place(P).
goal(dry_out(P)) :- place(P).
goal(fix_main(P)) :- place(P).
goal(visit(V)) :- victim(V).
goal(evacuate(P)) :- place(P).
goal(open_shelter(P)) :- place(P).
goal(search(P)) :- place(P).
goal(guard(S)) :- site(S).
goal(run_kitchen(P)) :- place(P).
goal(rescue(V, P)) :- victim(V), place(P).

% to be somewhere: already there, or by way of a vehicle, whose driver must get to it first
get_to(_, _) --> [].
get_to(X, S) --> {human(X), site(S)}, walk(S).
get_to(X, S) --> {human(X), vehicle(V), site(Q), site(S)}, get_to(V, Q), ride(X, V, S).
get_to(V, S) --> {vehicle(V), site(S)}, man(V), drive(V, S).
get_to(T, S) --> {tool(T), truck(V), site(S)}, carry(T, V, S).
ride(_, V, S) --> climb_in(V), get_to(V, S), climb_out(V).
man(_) --> [].
man(V) --> {driver(D), vehicle(V), site(S)}, get_to(D, S), climb_in(V).
carry(T, V, S) --> {truck(V), tool(T), site(Q)}, get_to(V, Q), load(T, V), get_to(V, S), unload(T, V).

clear_wreck(R) --> tow_away(R), close_off(R), optional(tidy(R)).
tow_away(R) --> {truck(T)}, get_to(T, R), tow(T, R).
tidy(R) --> {labourer(L)}, get_to(L, R), sweep(R).
clear_tree(R) --> cut_up(R), drag(R), close_off(R), optional(tidy(R)).
cut_up(R) --> {saw(S)}, get_to(S, R), run(S), saw_up(S, R), optional(stop(S)).
run(T) --> {tool(T)}, fuelled(T), start(T).
fuelled(_) --> [].
fuelled(T) --> refuel(T).

restore_power(P) --> {generator(G), place(P)}, unordered(get_to(G, P), make_safe(P)), connect(P, G).
connect(P, G) --> run(G), wire(G, P), flip(P).
fix_line(P) --> splice(P), restore_power(P), test_line(P).
dry_out(P) --> pump_out(P), heated(P).
guard(S) --> close_off(S), patrol(S).
search(P) --> light_up(P), {victim(V)}, find(V, P).
visit(V) --> treat(V), note(V).
run_kitchen(P) --> wash_up(P), feed(P).
make_safe(_) --> [].
make_safe(P) --> close_off(P).
pump_out(P) --> {pump(T)}, unordered(get_to(T, P), powered(P)), run(T), hose(T, P), optional(stop(T)).
powered(_) --> [].
powered(P) --> restore_power(P).
fix_main(P) --> dig_up(P), repair(P), optional(close_off(P)).
dig_up(P) --> {digger(D)}, get_to(D, P), run(D), dig(D, P).
repair(P) --> weld(P).
repair(P) --> pump_out(P), weld(P).

treat(V) --> {victim(V), place(P)}, medic_there(P), first_aid(V).
medic_there(P) --> {medic(M)}, get_to(M, P).
first_aid(V) --> bandage(V), optional(blanket(V)).
first_aid(V) --> splint(V), bandage(V).
rescue(V, P) --> treat(V), bring(V, P).
bring(V, P) --> {ambulance(A), place(Q)}, get_to(A, Q), lift_in(V, A), get_to(A, P), lift_out(V, A).
bring(V, P) --> {boat(B), place(Q)}, get_to(B, Q), lift_in(V, B), get_to(B, P), lift_out(V, B).

evacuate(P) --> announce(P), all_out(P), close_off(P).
all_out(P) --> fetch(P), count(P).
all_out(P) --> fetch(P), all_out(P).
fetch(P) --> {bus(B), victim(V), place(Q)}, get_to(B, P), lift_in(V, B), get_to(B, Q), lift_out(V, B).
open_shelter(P) --> unlock(P), unordered(heated(P), lit(P), optional(feed(P))).
heated(P) --> warm(P).
heated(P) --> restore_power(P), warm(P).
lit(_) --> [].
lit(P) --> light_up(P).
light_up(S) --> {light(L)}, get_to(L, S), run(L), raise(L, S), aim(L, S).
close_off(S) --> {barrier(B)}, get_to(B, S), block(B, S), optional(sign(S)).
close_off(S) --> radio(S), sign(S).
supply_water(P) --> {tank(T)}, fill(T), get_to(T, P), tap(T, P).
feed(P) --> supply_water(P), cook(P).
"""


GOALS = [line.split("(")[1] for line in PLANS.splitlines() if line.startswith("goal(")]


def domain_text() -> tuple[str, str]:
    """The ontology and the plans."""
    facts = "".join(f"{kind}({name}).\n" for kind, names in KINDS.items() for name in names.split())
    rules = []
    for action, kinds in ACTIONS.items():
        names = "STUVW"[: len(kinds.split())]
        body = ", ".join(["agent(A)", *(f"{kind}({name})" for name, kind in zip(names, kinds.split()))])
        rules.append(f"{action}(A, {', '.join(names)}) :- {body}.\n")
    return facts + TYPES + "".join(rules), PLANS


def domain() -> Domain:
    """The domain, loaded."""
    ontology, plans = domain_text()
    return Domain.from_text(ontology=ontology, plans=plans)
