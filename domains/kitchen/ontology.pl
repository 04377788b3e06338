% The kitchen's ontology: who and what there is, what can be done with it, and what is never so.
% Paper: figure "ontology", table "data properties", section "Verification".

% --- individuals -----------------------------------------------------------------------------------------------------
human(human).
tiago(tiago).

biscuits(biscuits).
meal(meal).
water_bottle(bottle).
plate(plate).
glass(glass).
sink(sink).
hobs(hobs).

% --- classes ---------------------------------------------------------------------------------------------------------
agent(X) :- human(X).
agent(X) :- robot(X).
robot(X) :- tiago(X).

food(X) :- biscuits(X).
food(X) :- meal(X).
food(X) :- water_bottle(X).
vessel(X) :- plate(X).
vessel(X) :- glass(X).
item(X) :- food(X).
item(X) :- vessel(X).
furniture(X) :- sink(X).
furniture(X) :- hobs(X).
object(X) :- item(X).
object(X) :- furniture(X).

% --- affordances -----------------------------------------------------------------------------------------------------
moveable(plate).     washable(plate).
moveable(glass).     washable(glass).     drinkable(glass).
moveable(biscuits).  eatable(biscuits).
moveable(meal).      eatable(meal).       cookable(meal).
moveable(bottle).    drinkable(bottle).

% --- actions: Action(Agent, Target, Destination) is valid when it is provable and breaks no constraint -----------------
pick_and_place(A, T, D) :- agent(A), item(T), moveable(T), container(D), T \= D.
eat(A, T, D)  :- human(A), food(T), eatable(T), vessel(D), plate(D).
sip(A, T, D)  :- human(A), beverage(T), drinkable(T), beverage(D), T \= D.
cook(A, T, D) :- agent(A), food(T), cookable(T), hobs(D).
wash(A, T, D) :- agent(A), vessel(T), washable(T), sink(D).

container(X) :- furniture(X).
container(X) :- vessel(X).
beverage(X) :- water_bottle(X).
beverage(X) :- glass(X).

% --- constraints -----------------------------------------------------------------------------------------------------
never("the biscuits go on the plate only") :- claim(pick_and_place(_, T, D)), biscuits(T), \+ plate(D).
never("the bottle goes to the glass only") :- claim(pick_and_place(_, T, D)), water_bottle(T), \+ glass(D).

never("nothing is both an agent and an object") :- agent(X), object(X).
never("nobody is both a human and a robot") :- human(X), robot(X).
never("nothing is both an item and furniture") :- item(X), furniture(X).
never("nothing is both food and a vessel") :- food(X), vessel(X).
never("the biscuits are neither the meal nor the bottle") :- biscuits(X), (meal(X) ; water_bottle(X)).
never("the meal is not the bottle") :- meal(X), water_bottle(X).
never("the plate is not the glass") :- plate(X), glass(X).
never("the sink is not the hobs") :- sink(X), hobs(X).
