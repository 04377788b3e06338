% movements.pl - which movement it is, learned: movement(Mos, Hold, Qdc, Qtc, Movement).
% Learned from 429 samples of 10 trials, at most 5 leaves, seed 1.
% A feature counts by its place in the order of its facts below.
% Leave-one-trial-out accuracy 0.9091 (by trial 0.8605 to 0.9583).
% Confusion counts (rows: true, columns: classified):
%                     pick      place      still  transport       walk
%   pick                64         17          2          3          1
%   place                1         52          0          3          0
%   still                0          0         78          0          5
%   transport            0          1          0         79          0
%   walk                 0          2          0          4        117

mos(still). mos(moving).
hold(free). hold(holding).
qdc(touch). qdc(near). qdc(medium). qdc(far). qdc(ignore).
qtc('-'). qtc('0'). qtc('+'). qtc(ignore).

movement(Mos, Hold, Qdc, Qtc, pick) :-  % 65 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = still, Hold = free, Qdc = touch.
movement(Mos, Hold, Qdc, Qtc, place) :-  % 72 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = still, Hold = holding, Qdc = touch.
movement(Mos, Hold, Qdc, Qtc, transport) :-  % 89 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = moving, Qdc = touch.
movement(Mos, Hold, Qdc, Qtc, still) :-  % 80 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = still, Qdc \= touch.
movement(Mos, Hold, Qdc, Qtc, walk) :-  % 123 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = moving, Qdc \= touch.

% emission(True, Seen, P): the cross-validated confusion, half a count added to each, as shares.
emission(pick, pick, 0.7207).
emission(pick, place, 0.1955).
emission(pick, still, 0.0279).
emission(pick, transport, 0.0391).
emission(pick, walk, 0.0168).
emission(place, pick, 0.0256).
emission(place, place, 0.8974).
emission(place, still, 0.0085).
emission(place, transport, 0.0598).
emission(place, walk, 0.0085).
emission(still, pick, 0.0058).
emission(still, place, 0.0058).
emission(still, still, 0.9181).
emission(still, transport, 0.0058).
emission(still, walk, 0.0643).
emission(transport, pick, 0.0061).
emission(transport, place, 0.0182).
emission(transport, still, 0.0061).
emission(transport, transport, 0.9636).
emission(transport, walk, 0.0061).
emission(walk, pick, 0.0040).
emission(walk, place, 0.0199).
emission(walk, still, 0.0040).
emission(walk, transport, 0.0359).
emission(walk, walk, 0.9363).
