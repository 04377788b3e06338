% The workshop, 6 m from west to east and 5 m from south to north, with (0, 0) in the middle. What is left out has
% sensible values (docs/rooms.md).
room_size(6, 5).

furniture(saw_bench,   counter, -2.0,  2.2, 1.0, 0.6).
furniture(drill_bench, counter, -0.2,  2.2, 1.0, 0.6).
furniture(press_bench, counter,  1.7,  2.2, 1.0, 0.6).
furniture(glue_table,  table,   -2.7, -0.2, 0.6, 1.0).
furniture(stock,       counter, -0.8, -2.2, 2.4, 0.6).
furniture(oven_bench,  counter,  2.7,  0.2, 0.6, 1.0).
furniture(store_rack,  counter,  1.9, -2.2, 1.2, 0.6).

position(saw,    saw_bench).      shape(saw,    panel).
position(drill,  drill_bench).    shape(drill,  panel).
position(press,  press_bench).    shape(press,  panel).
position(gluing, glue_table).     shape(gluing, panel).
position(oven,   oven_bench).     shape(oven,   panel).
position(store,  store_rack).     shape(store,  panel, 0.50, 0.40, 0.01).

position(seat,  stock).    shape(seat,  cylinder, 0.09, 0.09, 0.04).
position(block, stock).    shape(block, box,      0.07, 0.07, 0.07).
position(plate, stock).    shape(plate, box,      0.09, 0.06, 0.04).
position(dial,  stock).    shape(dial,  cylinder, 0.08, 0.08, 0.04).

colour(oven, 0.75, 0.25, 0.15).

setting(sensor, field_of_view, 360).           % a panoramic eye: there are two people to watch, also from the oven
