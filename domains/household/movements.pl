% movements.pl - which movement it is, learned: movement(Mos, Hold, Qdc, Qtc, Movement).
% Learned from 434 samples of 10 trials, at most 5 leaves, seed 1.
% A feature counts by its place in the order of its facts below.
% Leave-one-trial-out accuracy 0.9078 (by trial 0.8605 to 0.9592).
% Confusion counts (rows: true, columns: classified):
%                     pick      place      still  transport       walk
%   pick                64         17          4          2          1
%   place                1         52          0          1          0
%   still                0          0         84          0          3
%   transport            0          2          0         80          0
%   walk                 1          2          4          2        114

mos(still). mos(moving).
hold(free). hold(holding).
qdc(touch). qdc(near). qdc(medium). qdc(far). qdc(ignore).
qtc('-'). qtc('0'). qtc('+'). qtc(ignore).

movement(Mos, Hold, Qdc, Qtc, pick) :-  % 66 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = still, Hold = free, Qdc = touch.
movement(Mos, Hold, Qdc, Qtc, place) :-  % 73 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = still, Hold = holding, Qdc = touch.
movement(Mos, Hold, Qdc, Qtc, transport) :-  % 85 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = moving, Qdc = touch.
movement(Mos, Hold, Qdc, Qtc, still) :-  % 92 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = still, Qdc \= touch.
movement(Mos, Hold, Qdc, Qtc, walk) :-  % 118 samples
    mos(Mos), hold(Hold), qdc(Qdc), qtc(Qtc),
    Mos = moving, Qdc \= touch.

% emission(True, Seen, P): the cross-validated confusion, half a count added to each, as shares.
emission(pick, pick, 0.7127).
emission(pick, place, 0.1934).
emission(pick, still, 0.0497).
emission(pick, transport, 0.0276).
emission(pick, walk, 0.0166).
emission(place, pick, 0.0265).
emission(place, place, 0.9292).
emission(place, still, 0.0088).
emission(place, transport, 0.0265).
emission(place, walk, 0.0088).
emission(still, pick, 0.0056).
emission(still, place, 0.0056).
emission(still, still, 0.9441).
emission(still, transport, 0.0056).
emission(still, walk, 0.0391).
emission(transport, pick, 0.0059).
emission(transport, place, 0.0296).
emission(transport, still, 0.0059).
emission(transport, transport, 0.9527).
emission(transport, walk, 0.0059).
emission(walk, pick, 0.0120).
emission(walk, place, 0.0199).
emission(walk, still, 0.0359).
emission(walk, transport, 0.0199).
emission(walk, walk, 0.9124).
