% What the kitchen's author expects of it; casper check kitchen tries each one out.

example(valid, eat(human, biscuits, plate)).
example(valid, wash(tiago, plate, sink)).
example(valid, cook(human, meal, hobs)).
example(invalid, eat(tiago, meal, plate), "tiago is not a human").
example(invalid, pick_and_place(human, biscuits, hobs), "biscuits go on the plate only").

example(reads, [pick_and_place(biscuits, plate)], 'breakfast').
example(reads, [pick_and_place(bottle, glass), sip], 'drink').
example(reads, [pick_and_place(meal, hobs), cook(meal, hobs)], 'lunch').
