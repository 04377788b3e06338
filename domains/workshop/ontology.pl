% A workshop where two people and a robot assemble things at shared machines: who may do what, with what, and where.

% --- who -------------------------------------------------------------------------------------------------------------
human(ida).
human(otto).
robot(rover).                                  % the robot watches both of them
agent(X) :- human(X).
agent(X) :- robot(X).

% --- workpieces, and the machines that everybody shares ------------------------------------------------------------------
wooden(seat).    wooden(block).
metal(plate).    metal(dial).
part(X) :- wooden(X).
part(X) :- metal(X).

machine(saw).    machine(drill).    machine(press).    machine(gluing).    machine(oven).
place(X) :- machine(X).
place(store).

hot(oven).                                     % only the robot may come near

% --- actions: Action(Agent, Part, Place) -----------------------------------------------------------------------------
pick_and_place(A, T, P) :- agent(A), part(T), place(P).
cut(A, T, saw)          :- human(A), wooden(T).
bore(A, T, drill)       :- human(A), part(T).
rivet(A, T, press)      :- human(A), part(T).
glue(A, T, gluing)      :- human(A), part(T).
bake(A, T, oven)        :- robot(A), part(T).

% --- what must never happen --------------------------------------------------------------------------------------------
never("people keep away from the oven") :-
    claim(pick_and_place(A, _, P)), human(A), hot(P).
never("nothing goes into the oven that was not joined") :-
    claim(pick_and_place(_, T, P)), hot(P), \+ did(rivet(_, T, _), _), \+ did(glue(_, T, _), _).
never("metal does not go under the saw") :-
    claim(pick_and_place(_, T, saw)), metal(T).

never("nothing is both wooden and metal") :- wooden(X), metal(X).
never("nobody is both a person and a robot") :- human(X), robot(X).
