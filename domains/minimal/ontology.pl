% Who there is, what there is, and when an action is valid: Action(Agent, Thing, Place). casper query FOLDER "valid(S)"
human(ann).    robot(robbie).                   % Ann is watched, Robbie helps
agent(X) :- human(X).    agent(X) :- robot(X).  % a rule: X is an agent if X is a human; or if X is a robot
thing(cup).    thing(book).    place(tray).    place(shelf).

pick_and_place(A, T, P) :- agent(A), thing(T), place(P).
drink(A, cup, tray) :- human(A).
never("the book stays dry") :- claim(pick_and_place(_, book, tray)).    % a constraint: the sentence people are shown
