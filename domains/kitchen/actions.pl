% From world states to actions. What holds of any household comes from the shipped library; here is what the paper's
% kitchen sets, and what a use means where (table context, and the bottle).

:- include("household/actions.pl").

setting(perception, qtc, projection).           % QSRlib's QTC_B; distance is the textbook's
setting(focus, w_qdc, 0.8).
setting(focus, w_qtc, 0.2).
setting(focus, angle_unit, degrees).            % of theta; the paper gives none
setting(focus, threshold, 0.45).                % tau, as published with the code; the paper prints 0.5
setting(focus, steady, false).                  % as published: who attended to a place once has it until another wins
setting(actions, recogniser, hmm).              % ratcliff is the paper's

context(use, sink, wash).
context(use, hobs, cook).
context(use, plate, eat).
context(use, glass, sip).
context(use, bottle, sip).
