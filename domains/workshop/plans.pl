% What is made in the workshop. A semicolon separates alternatives; by(Who, Step) says whose step it is: by(robot, …) is
% the robot's alone, and the same variable in two steps means the same person in both.

stool --> sawn(seat),   joined(seat),   finished(seat).
toy   --> sawn(block),  optional(bored(block)), glued(block), finished(block).
lamp  --> bored(plate), riveted(plate), finished(plate).
clock --> bored(dial),  joined(dial),   finished(dial).

sawn(Part)   --> pick_and_place(Part, saw),   cut(Part, saw).
bored(Part)  --> pick_and_place(Part, drill), bore(Part, drill).
joined(Part) --> (riveted(Part) ; glued(Part)).

riveted(Part) --> by(Who, pick_and_place(Part, press)),  by(Who, rivet(Part, press)).      % who brings it rivets it
glued(Part)   --> by(Who, pick_and_place(Part, gluing)), by(Who, glue(Part, gluing)).

finished(Part) --> by(robot, pick_and_place(Part, oven)), by(robot, bake(Part, oven)), pick_and_place(Part, store).
