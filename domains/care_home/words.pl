% The care home's sentences: reasons, questions and announcements are told in them. {X} stands for the value of X, and
% \+ Term is that it does not hold. What has no sentence here is told as the term it is.

say(rosa, "Rosa").          say(nora, "Nora").          say(robin, "Robin").
say(bowl, "the porridge").  say(bread, "the bread").    say(pills, "the pills").
say(cuff, "the cuff").      say(novel, "the novel").    say(glasses, "the glasses").
say(tray, "the tray").      say(basin, "the basin").    say(pad, "the pad").          say(saucer, "the saucer").
say(drawer, "the drawer").  say(lectern, "the lectern"). say(bookcase, "the bookcase").

say(pick_and_place(A, T, P), "{A} brings {T} to {P}").   say(pick_and_place(T, P), "bringing {T} to {P}").
say(eat(A, T, _), "{A} eats {T}").                       say(eat(T, _), "eating {T}").
say(measure(A, _, _), "{A} measures the blood pressure").  say(measure(_, _), "measuring the blood pressure").
say(take(A, T, _), "{A} takes {T}").                     say(take(T, _), "taking {T}").
say(read(A, T, _), "{A} reads {T}").                     say(read(T, _), "reading {T}").
say(wash(A, T, _), "{A} washes {T} up").                 say(wash(T, _), "washing {T} up").

say(\+ pick_and_place(A, T, P), "{A} cannot bring {T} to {P}").
say(\+ take(A, T, _), "{A} cannot take {T}").
say(\+ eat(A, T, _), "{A} cannot eat {T}").
say(\+ human(A), "{A} is not a person").
say(\+ resident(A), "{A} does not live here").
