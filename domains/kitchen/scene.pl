% The kitchen as the simulator builds it. Metres, kilograms, seconds, degrees; x points east, y north, z up.

% The two bodies that move by themselves, and where the robot starts: start(Name, X, Y, Heading).
% A body without a start begins at a random place of the walkable region.
body(human, person).
body(tiago, mobile_manipulator).
start(tiago, -0.16, -3.54, 90).

% The walls: corners of the outline in order.
outline(1,  2.15,  1.62).
outline(2, -2.14,  1.62).
outline(3, -2.14, -3.80).
outline(4,  1.13, -3.80).
outline(5,  1.13, -1.95).
outline(6,  2.15, -1.95).

% The floor one can walk on: corners in order, less the holes: hole(Name, MinX, MinY, MaxX, MaxY).
walkable(1, -2.14,  0.95).
walkable(2,  1.42,  0.95).
walkable(3,  1.42, -1.95).
walkable(4,  1.13, -1.95).
walkable(5,  1.13, -3.80).
walkable(6, -1.44, -3.80).
walkable(7, -1.44, -3.20).
walkable(8, -2.14, -3.20).
hole(dining_table, -1.09, -1.88, -0.20, -0.98).

% furniture(Name, Kind, X, Y, SizeX, SizeY, Top). A counter is solid (with a cut-out where a basin is), a table stands
% on legs, a cabinet is an open-fronted box: shelf(Name, Height) is its board, opens(Name, Side) the side without a wall.
furniture(worktop_4,      counter,  0.33,   1.31,  2.25, 0.69,  0.86).
furniture(long_worktop,   counter,  1.79,   0.44,  0.70, 2.43,  0.86).
furniture(west_worktop,   counter, -1.45,   1.31,  0.43, 0.70,  0.86).
furniture(sink_unit,      counter, -1.015,  1.31,  0.44, 0.69,  0.86).
furniture(dining_table,   table,   -0.64,  -1.43,  0.90, 0.90,  0.74).
furniture(coffee_table,   table,   -1.78,  -3.50,  0.70, 0.60,  0.60).
furniture(fridge,         cabinet,  1.795, -1.58,  0.71, 0.74,  1.85).
shelf(fridge, 0.98).
opens(fridge, west).
% Nothing is known of these two corners but that nobody can walk there.
furniture(west_cupboard,  counter, -1.9025, 1.31,  0.475, 0.70, 0.86).
furniture(fridge_side,    counter,  1.795, -0.9925, 0.71, 0.435, 0.86).

% The objects of interest. position(Name, X, Y, Z): a movable one stands on the furniture below that point.
position(sink,     -1.01,  1.33, 0.87).
position(hobs,      1.59,  1.11, 0.86).
position(glass,     0.21,  1.13, 0.89).
position(biscuits,  1.61, -0.42, 0.89).
position(meal,      1.67, -1.58, 1.02).
position(plate,    -0.66, -1.15, 0.74).
position(bottle,   -2.01, -3.37, 0.60).

% shape(Name, Kind, SizeX, SizeY, SizeZ). A dish is round with a raised rim; a basin is let into a counter, its sizes are
% the inside's and its position the rim's; a panel lies on a counter, its position being the underside.
shape(sink,     basin,    0.40, 0.44, 0.07).
shape(hobs,     panel,    0.32, 0.32, 0.01).
shape(glass,    dish,     0.09, 0.09, 0.06).
shape(biscuits, box,      0.08, 0.06, 0.06).
shape(meal,     cylinder, 0.07, 0.07, 0.08).
shape(plate,    dish,     0.24, 0.24, 0.03).
shape(bottle,   cylinder, 0.07, 0.07, 0.20).

% What has a mass can be moved.
mass(glass,    0.20).
mass(biscuits, 0.15).
mass(meal,     0.30).
mass(plate,    0.40).
mass(bottle,   0.40).

% How something is put at a place: inside it, on_top of it, or beside it.
placing(sink,  inside).
placing(hobs,  on_top).
placing(plate, inside).
placing(glass, beside).

% consumes(Action): what was its target is gone when the partner has finished the action.
consumes(eat).

% colour(Name, Red, Green, Blue), for pictures only.
colour(sink,     0.75, 0.78, 0.80).
colour(hobs,     0.10, 0.10, 0.12).
colour(glass,    0.45, 0.75, 0.90).
colour(biscuits, 0.85, 0.55, 0.20).
colour(meal,     0.80, 0.15, 0.15).
colour(plate,    0.95, 0.95, 0.98).
colour(bottle,   0.15, 0.45, 0.85).

% The simulation: seconds of a physics step, of a control step, and between two world states.
setting(sim, timestep, 0.01).
setting(sim, control,  0.02).
setting(sim, period,   0.5).

% The partner: m/s, rad/s, metres and seconds. Standing distance: inside the touch band (0.6 m).
setting(human, radius,         0.17).
setting(human, walk_speed,     0.6).
setting(human, turn_rate,      2.5).
setting(human, stand_distance, 0.55).
setting(human, pause_min,      1.0).
setting(human, pause_max,      2.0).
setting(human, pick_time,      2.5).
setting(human, place_time,     3.0).
setting(human, use_half,       3.0).
setting(human, use_pairs,      3).

% The robot: m/s, rad/s, metres and seconds; it gives up what has not worked within the patience.
setting(robot, radius,         0.28).
setting(robot, drive_speed,    0.6).
setting(robot, turn_rate,      1.2).
setting(robot, reach_speed,    0.3).
setting(robot, stand_distance, 0.56).
setting(robot, grasp_distance, 0.03).
setting(robot, use_time,       5.0).
setting(robot, patience,       60.0).
% Among people, as gaps between outlines: ways keep away so far, the robot slows down within so far, to so many m/s, and
% nothing of it moves within the last; and how often it tries again what went wrong.
setting(robot, keep_distance,  0.2).
setting(robot, slow_distance,  0.4).
setting(robot, slow_speed,     0.25).
setting(robot, stop_distance,  0.1).
setting(robot, retries,        2).

% The robot's eye: degrees, metres, degrees/s; noise is a standard deviation; drops and misreads are probabilities.
setting(sensor, field_of_view, 95.0).
setting(sensor, range,         7.0).
setting(sensor, pan_limit,     75.0).
setting(sensor, pan_rate,      90.0).
setting(sensor, noise,         0.01).
setting(sensor, heading_noise, 2.0).
setting(sensor, drop,          0.02).
setting(sensor, hold_distance, 0.05).
setting(sensor, hold_misread,  0.01).
