% The kitchen's plan library (paper: figure "plans", L = {Sigma, NT, G, T}): a goal or task produces tasks and actions.

goal(breakfast(Food)) :- biscuits(Food).
goal(drink(Beverage)) :- water_bottle(Beverage).
goal(lunch(Food))     :- meal(Food).

breakfast(Food)    --> pick_and_place(Food, plate), eat(Food, plate), clean(plate).
drink(Beverage)    --> pick_and_place(Beverage, glass), sip(_, _), clean(glass).
lunch(Food)        --> prepare_meal(Food), eat(Food, plate), clean(plate).

prepare_meal(Food) --> warm(Food), pick_and_place(Food, plate).
warm(Food)         --> pick_and_place(Food, hobs), cook(Food, hobs).
clean(Vessel)      --> pick_and_place(Vessel, sink), wash(Vessel, sink).
