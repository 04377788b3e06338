% A morning in a care home: who and what there is, who may do what with it, and what must never happen.
% casper query care_home "valid(take(rosa, T, P))" asks for everything that Rosa may take, and where.

% --- who -------------------------------------------------------------------------------------------------------------
resident(rosa).
carer(nora).
robot(robin).

human(X) :- resident(X).
human(X) :- carer(X).
agent(X) :- human(X).
agent(X) :- robot(X).

setting(agents, partner, rosa).       % it is Rosa whom the robot watches and helps; Nora is next door

% --- what ------------------------------------------------------------------------------------------------------------
food(bowl).       food(bread).        % the bowl is full of porridge
medicine(pills).
meter(cuff).                          % for the blood pressure
book(novel).      spectacles(glasses).

item(X) :- food(X).
item(X) :- medicine(X).
item(X) :- meter(X).
item(X) :- book(X).
item(X) :- spectacles(X).

% --- where: what is done at a place, and what may be put there ----------------------------------------------------------
place_for(tray, X)     :- food(X).
place_for(basin, bowl).
place_for(pad, X)      :- meter(X).
place_for(saucer, X)   :- medicine(X).
place_for(drawer, X)   :- medicine(X).
place_for(drawer, X)   :- meter(X).
place_for(lectern, X)  :- book(X).
place_for(lectern, X)  :- spectacles(X).
place_for(bookcase, X) :- book(X).
place_for(bookcase, X) :- spectacles(X).

% --- actions: Action(Agent, Target, Place) -------------------------------------------------------------------------------
pick_and_place(A, T, P) :- agent(A), item(T), place_for(P, T).
eat(A, T, tray)         :- human(A), food(T).
measure(A, T, pad)      :- human(A), meter(T).
take(A, T, saucer)      :- resident(A), medicine(T).
read(A, T, lectern)     :- human(A), book(T).
wash(A, bowl, basin)    :- agent(A).

% --- what must never happen --------------------------------------------------------------------------------------------
% What happened earlier is did(Statement, Seconds): a rule may ask whether, in which order, and how long apart.
never("a robot lays out no medicine") :-
    claim(pick_and_place(A, M, saucer)), robot(A), medicine(M).
never("nobody takes medicine on an empty stomach") :-
    claim(take(A, M, _)), medicine(M), \+ did(eat(A, _, _), _).
never("nobody takes a medicine twice in a morning") :-
    claim(take(A, M, _)), did(take(A, M, _), _).
never("there is no medicine before the blood pressure was measured") :-
    claim(take(A, M, _)), medicine(M), \+ did(measure(A, _, _), _).
never("a measurement from more than half an hour before the meal says nothing about the pills") :-
    claim(take(A, M, _)), medicine(M), did(measure(A, _, _), Measured), did(eat(A, _, _), Eaten), Eaten - Measured > 1800.
never("nothing is put in the basin before it was eaten from") :-
    claim(pick_and_place(_, T, basin)), food(T), \+ did(eat(_, T, _), _).

never("nothing is both food and medicine") :- food(X), medicine(X).
never("nobody is both a person and a robot") :- human(X), robot(X).
