% The kitchen's sentences, in English and in French: what reasons, proofs, questions and the robot's announcements are
% told in with --language. say(Language, Term, Sentence): {X} stands for the value of X; \+ Term is that it does not hold.
% Without --language, and for whatever has no sentence here, the terms themselves are told.

% --- who and what ----------------------------------------------------------------------------------------------------
say(en, human, "the partner").       say(fr, human, "la personne").
say(en, tiago, "Tiago").             say(fr, tiago, "Tiago").
say(en, biscuits, "the biscuits").   say(fr, biscuits, "les biscuits").
say(en, meal, "the meal").           say(fr, meal, "le repas").
say(en, bottle, "the bottle").       say(fr, bottle, "la bouteille").
say(en, plate, "the plate").         say(fr, plate, "l'assiette").
say(en, glass, "the glass").         say(fr, glass, "le verre").
say(en, sink, "the sink").           say(fr, sink, "l'évier").
say(en, hobs, "the hobs").           say(fr, hobs, "la cuisinière").

% --- actions ---------------------------------------------------------------------------------------------------------
say(en, pick_and_place(A, T, D), "{A} takes {T} to {D}").
say(en, eat(A, T, D), "{A} eats {T} from {D}").
say(en, sip(A, T, D), "{A} drinks from {T} by {D}").
say(en, cook(A, T, D), "{A} cooks {T} on {D}").
say(en, wash(A, T, D), "{A} washes {T} in {D}").
% As steps of a plan, whoever does them.
say(en, pick_and_place(T, D), "taking {T} to {D}").
say(en, eat(T, D), "eating {T} from {D}").
say(en, sip(T, D), "drinking from {T} by {D}").
say(en, cook(T, D), "cooking {T} on {D}").
say(en, wash(T, D), "washing {T} in {D}").
% What cannot be.
say(en, \+ pick_and_place(A, T, D), "{A} cannot take {T} to {D}").
say(en, \+ eat(A, T, D), "{A} cannot eat {T} from {D}").
say(en, \+ sip(A, T, D), "{A} cannot drink from {T} by {D}").
say(en, \+ cook(A, T, D), "{A} cannot cook {T} on {D}").
say(en, \+ wash(A, T, D), "{A} cannot wash {T} in {D}").

say(fr, pick_and_place(A, T, D), "{A} porte {T} vers {D}").
say(fr, eat(A, T, D), "{A} mange {T} dans {D}").
say(fr, sip(A, T, D), "{A} boit avec {T} et {D}").
say(fr, cook(A, T, D), "{A} cuit {T} sur {D}").
say(fr, wash(A, T, D), "{A} lave {T} dans {D}").
say(fr, pick_and_place(T, D), "porter {T} vers {D}").
say(fr, eat(T, D), "manger {T} dans {D}").
say(fr, sip(T, D), "boire avec {T} et {D}").
say(fr, cook(T, D), "cuire {T} sur {D}").
say(fr, wash(T, D), "laver {T} dans {D}").
say(fr, \+ pick_and_place(A, T, D), "{A} ne peut pas porter {T} vers {D}").
say(fr, \+ eat(A, T, D), "{A} ne peut pas manger {T} dans {D}").
say(fr, \+ sip(A, T, D), "{A} ne peut pas boire avec {T} et {D}").
say(fr, \+ cook(A, T, D), "{A} ne peut pas cuire {T} sur {D}").
say(fr, \+ wash(A, T, D), "{A} ne peut pas laver {T} dans {D}").

% --- what things are -------------------------------------------------------------------------------------------------
say(en, human(X), "{X} is a person").            say(en, \+ human(X), "{X} is not a person").
say(en, agent(X), "{X} can act").                say(en, \+ agent(X), "{X} is nobody who could act").
say(en, food(X), "{X}: something to eat or drink").
say(en, \+ food(X), "{X}: nothing to eat or drink").
say(en, eatable(X), "{X} can be eaten").         say(en, \+ eatable(X), "{X} cannot be eaten").
say(en, drinkable(X), "one can drink from {X}"). say(en, \+ drinkable(X), "nobody can drink from {X}").
say(en, cookable(X), "{X} can be cooked").       say(en, \+ cookable(X), "{X} cannot be cooked").
say(en, washable(X), "{X} can be washed").       say(en, \+ washable(X), "{X} cannot be washed").
say(en, moveable(X), "{X} can be moved").        say(en, \+ moveable(X), "{X} cannot be moved").
say(en, \+ vessel(X), "{X}: no vessel").           say(en, \+ container(X), "nothing can be put into {X}").

say(fr, human(X), "{X} est une personne").         say(fr, \+ human(X), "{X} n'est pas une personne").
say(fr, robot(X), "{X} est un robot").             say(fr, \+ robot(X), "{X} n'est pas un robot").
say(fr, agent(X), "{X} peut agir").              say(fr, \+ agent(X), "{X} ne peut pas agir").
say(fr, food(X), "{X} se mange ou se boit").     say(fr, \+ food(X), "{X} : ni à manger ni à boire").
say(fr, eatable(X), "on peut manger {X}").       say(fr, \+ eatable(X), "on ne peut pas manger {X}").
say(fr, drinkable(X), "on boit avec {X}").       say(fr, \+ drinkable(X), "on ne boit pas avec {X}").
say(fr, cookable(X), "on peut cuire {X}").       say(fr, \+ cookable(X), "on ne peut pas cuire {X}").
say(fr, washable(X), "on peut laver {X}").       say(fr, \+ washable(X), "on ne peut pas laver {X}").
say(fr, moveable(X), "on peut déplacer {X}").    say(fr, \+ moveable(X), "on ne peut pas déplacer {X}").
say(fr, vessel(X), "{X} : un récipient").        say(fr, \+ vessel(X), "{X} : pas un récipient").
say(fr, container(X), "on peut poser dans {X}"). say(fr, \+ container(X), "on ne peut rien poser dans {X}").

% --- goals -----------------------------------------------------------------------------------------------------------
say(fr, breakfast(_), "le petit-déjeuner").
say(fr, drink(_), "boire quelque chose").
say(fr, lunch(_), "le déjeuner").

% --- constraints -----------------------------------------------------------------------------------------------------
say(fr, never("the biscuits go on the plate only"), "les biscuits ne vont que sur l'assiette").
say(fr, never("the bottle goes to the glass only"), "la bouteille ne va que vers le verre").
