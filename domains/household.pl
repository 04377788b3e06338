% What a room with people in it has in common with others: how their actions are made out, and which movement is which.
% A domain takes it over with the line
%
%     :- include("household.pl").
%
% Who learns their own movements (casper train) includes household/actions.pl alone.

:- include("household/actions.pl").
:- include("household/movements.pl").
