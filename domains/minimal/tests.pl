% What you expect of it. casper check FOLDER tries each one out, and says what is so instead.
example(valid, drink(ann, cup, tray)).
example(invalid, drink(robbie, cup, tray), "robbie is not a human").
example(invalid, pick_and_place(ann, book, tray), "the book stays dry").
example(reads, [pick_and_place(cup, tray)], tea).
