% The room: metres, east and north, (0, 0) in the middle. Sizes, masses, paths, where the robot starts: sensible values.
room_size(4, 3.5).
furniture(table, table, -1.2, 1.2).    furniture(counter, counter, 1.2, 1.3).    furniture(rack, counter, 0, -1.3).
position(cup, table).    shape(cup, cylinder).     position(tray, counter).    shape(tray, panel).
position(book, table).   shape(book, box).         position(shelf, rack).      shape(shelf, panel).
