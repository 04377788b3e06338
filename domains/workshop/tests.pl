% What is expected of the workshop; casper check workshop tries each one out.

example(valid, cut(ida, seat, saw)).
example(valid, rivet(otto, dial, press)).
example(valid, pick_and_place(rover, seat, oven), [did(glue(ida, seat, gluing), 60)]).
example(invalid, pick_and_place(rover, seat, oven), "not joined").
example(invalid, pick_and_place(ida, seat, oven), "people keep away from the oven").
example(invalid, pick_and_place(otto, plate, saw), "metal does not go under the saw").
example(invalid, cut(rover, seat, saw), "rover is not a human").
example(invalid, bake(ida, seat, oven), "ida is not a robot").

example(reads, [pick_and_place(seat, saw)], stool).
example(reads, [pick_and_place(block, saw), cut(block, saw), pick_and_place(block, gluing)], toy).
example(reads, [pick_and_place(dial, drill), bore(dial, drill), pick_and_place(dial, press)], clock).
example(reads, [pick_and_place(plate, drill)], lamp).
