% What is expected of the care home; casper check care_home tries each one out.

example(valid, eat(rosa, bowl, tray)).
example(valid, pick_and_place(robin, pills, drawer)).
example(invalid, pick_and_place(robin, pills, saucer), "a robot lays out no medicine").
example(invalid, eat(robin, bowl, tray), "Robin is not a person").

% Medicine looks back: was there something to eat, was the pressure measured, and was that not too long ago?
example(invalid, take(rosa, pills, saucer), "on an empty stomach").
example(invalid, take(rosa, pills, saucer), "before the blood pressure was measured", [did(eat(rosa, bread, tray), 60)]).
example(valid, take(rosa, pills, saucer), [did(measure(rosa, cuff, pad), 40), did(eat(rosa, bread, tray), 90)]).
example(invalid, take(rosa, pills, saucer), "more than half an hour",
    [did(measure(rosa, cuff, pad), 40), did(eat(rosa, bread, tray), 2000)]).
example(invalid, take(rosa, pills, saucer), "twice",
    [did(measure(rosa, cuff, pad), 40), did(eat(rosa, bread, tray), 90), did(take(rosa, pills, saucer), 120)]).

example(reads, [pick_and_place(bowl, tray)], breakfast).
example(reads, [pick_and_place(cuff, pad)], medicine).
example(reads, [pick_and_place(bread, tray), eat(bread, tray)], medicine).
example(reads, [pick_and_place(novel, lectern)], reading).
example(reads, [pick_and_place(glasses, lectern), pick_and_place(novel, lectern)], reading).
