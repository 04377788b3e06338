% What Ann may be after, step by step; who does it is left out. A name with an arrow is a goal or a task of one.
tea  --> pick_and_place(cup, tray), drink(cup, tray), clear(cup).
tidy --> clear(book).
clear(Thing) --> pick_and_place(Thing, shelf).
