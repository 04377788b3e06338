% What Rosa may be after on a morning. Whatever stands in optional(…) she may leave out, and what stands in unordered(…)
% she may do in any order.

breakfast --> pick_and_place(bowl, tray), eat(bowl, tray), wash_up(bowl).
medicine  --> unordered(pressure, bite), dose(pills), put_away.
reading   --> optional(pick_and_place(glasses, lectern)), pick_and_place(novel, lectern), read(novel, lectern),
              pick_and_place(novel, bookcase).

wash_up(Dish) --> pick_and_place(Dish, basin), wash(Dish, basin).
pressure      --> pick_and_place(cuff, pad), measure(cuff, pad).
bite          --> pick_and_place(bread, tray), eat(bread, tray).
dose(Pills)   --> pick_and_place(Pills, saucer), take(Pills, saucer).
put_away      --> pick_and_place(pills, drawer), pick_and_place(cuff, drawer).
