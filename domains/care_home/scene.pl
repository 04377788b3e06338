% The day room, 5.4 m from west to east and 4.8 m from south to north, with (0, 0) in the middle. What is left out has
% sensible values (docs/rooms.md): sizes, masses, where one can walk, where the robot starts.
room_size(5.4, 4.8).

furniture(kitchenette, counter, -1.5,  2.1, 1.4, 0.6).
furniture(sink_unit,   counter,  0.9,  2.1, 0.8, 0.6).
furniture(table,       table,    0.3, -0.2, 0.9, 0.7).
furniture(dresser,     counter, -2.4,  0.1, 0.6, 1.5).
furniture(desk,        table,   -1.3, -2.1, 1.0, 0.6).
furniture(side_table,  table,    0.7, -2.1, 0.8, 0.6).
furniture(window_seat, table,    2.4,  0.6, 0.6, 0.9).
furniture(shelves,     counter,  2.4, -1.2, 0.6, 1.4).

position(bowl,    -1.8,  2.05).    shape(bowl,    dish, 0.16, 0.16, 0.05).
position(bread,   -1.2,  2.05).    shape(bread,   box).
position(basin,   sink_unit).      shape(basin,   basin).
position(tray,    table).          shape(tray,    panel).
position(cuff,    -2.35, 0.6).     shape(cuff,    box,  0.08, 0.07, 0.06).
position(pills,   -2.35, 0.2).     shape(pills,   cylinder, 0.06, 0.06, 0.08).
position(drawer,  -2.35, -0.4).    shape(drawer,  panel, 0.40, 0.40, 0.01).
position(pad,     desk).           shape(pad,     panel).
position(saucer,  side_table).     shape(saucer,  panel, 0.24, 0.24, 0.01).
position(lectern, window_seat).    shape(lectern, panel, 0.36, 0.36, 0.01).
position(novel,   2.35, -0.8).     shape(novel,   box,  0.09, 0.07, 0.04).
position(glasses, 2.35, -1.1).     shape(glasses, box,  0.08, 0.05, 0.04).
position(bookcase, 2.35, -1.6).    shape(bookcase, panel).
