% From world states to actions, for people who fetch, carry, put and use things in a room. A domain that has the line
%
%     :- include("household/actions.pl").
%
% needs of its own only what a use means where it happens, context(use, Place, Action), and what it sets differently:
% setting(focus, threshold, 0.5). What is set nowhere has the value shown in the comments here.
% Sections and figures are those of the CASPER paper.

% --- Perception (section Perception) ------------------------------------------------------------------------
% QDC: the first label whose distance in metres is not exceeded; upper ends are closed.
band(touch, 0.6).
band(near, 2.0).
band(medium, 3.0).
band(far, 5.0).
band(ignore, infinite).

% setting(perception, moving_speed, 0.09).        % m/s; MOS is moving above it
% setting(perception, qtc_speed, 0.09).           % m/s; QTC is 0 up to it, so one who stands still has 0 throughout
% setting(perception, qtc, projection).           % QSRlib's QTC_B; distance is the textbook's
% setting(perception, snap_held, true).           % what is held is where its holder is

% --- Tracking: what is not seen is where it was last known to be --------------------------------------------
% setting(tracking, enabled, true).
% setting(tracking, gate, 0.15).                  % metres; within it a detection of a resting thing is averaged
% setting(tracking, agent_gate, 0.08).            % the same for an agent; less than its slowest step
% setting(tracking, hold_bridge, 1).              % steps for which a hand that seems empty still holds
% setting(tracking, association, name).           % nearest: numbers of names (cup_1, cup_2) say nothing
% setting(tracking, steady, true).                % a sensor that is found to be poor is filtered, and told later
% setting(tracking, steady_noise, 0.02).          % metres of noise from which it is poor
% setting(tracking, lag, 1.5).                    % seconds that are then looked ahead
% setting(tracking, agent_bridge, 2.0).           % seconds an agent out of sight goes on as it went

% --- Focus (section Focus Estimation, equation focus, table encodings) --------------------------------------
encoding(qdc, touch, 0.5).
encoding(qdc, near, 0.25).
encoding(qdc, medium, 0.125).
encoding(qdc, far, 0.0).
encoding(qdc, ignore, 0.0).
encoding(qtc, '0', 0.5).
encoding(qtc, '-', 0.25).
encoding(qtc, '+', 0.0).

% setting(focus, w_qdc, 0.8).
% setting(focus, w_qtc, 0.2).
% setting(focus, angle_unit, degrees).            % of theta; the paper gives none
% setting(focus, angle_resolution, 10.0).         % degrees; at 1, as published, noise decides between things in one place
% setting(focus, threshold, 0.45).                % tau, as published with the code; the paper prints 0.5
% setting(focus, target_window, 4).
% setting(focus, target_votes, 3).
% setting(focus, destination_window, 5).
% setting(focus, destination_votes, 3).
% setting(focus, destination_minimum, 0.05).
% setting(focus, tie_tolerance, 0.0).
% setting(focus, steady, true).                   % a destination counts for an action only while it is attended to

% --- Actions (section Action Prediction, figure fsm) --------------------------------------------------------
% transition(Action, From, To, P); what is not here has probability 0.
transition(pick_and_place, still, walk, 0.033).
transition(pick_and_place, still, transport, 0.033).
transition(pick_and_place, still, pick, 0.9).
transition(pick_and_place, still, place, 0.033).
transition(pick_and_place, walk, still, 0.1).
transition(pick_and_place, walk, pick, 0.9).
transition(pick_and_place, transport, still, 0.1).
transition(pick_and_place, transport, place, 0.9).
transition(pick_and_place, pick, still, 0.05).
transition(pick_and_place, pick, transport, 0.9).
transition(pick_and_place, pick, place, 0.05).
transition(pick_and_place, place, still, 0.033).
transition(pick_and_place, place, walk, 0.033).
transition(pick_and_place, place, pick, 0.9).
transition(pick_and_place, place, place, 0.033).

transition(use, still, walk, 0.05).
transition(use, still, transport, 0.05).
transition(use, still, pick, 0.45).
transition(use, still, place, 0.45).
transition(use, walk, still, 0.1).
transition(use, walk, pick, 0.9).
transition(use, transport, still, 0.1).
transition(use, transport, place, 0.9).
transition(use, pick, still, 0.05).
transition(use, pick, transport, 0.05).
transition(use, pick, place, 0.9).
transition(use, place, still, 0.05).
transition(use, place, walk, 0.05).
transition(use, place, pick, 0.9).

transition(relocate, still, walk, 0.9).
transition(relocate, still, transport, 0.033).
transition(relocate, still, pick, 0.033).
transition(relocate, still, place, 0.033).
transition(relocate, walk, still, 0.9).
transition(relocate, walk, pick, 0.1).
transition(relocate, transport, still, 0.9).
transition(relocate, transport, place, 0.1).
transition(relocate, pick, still, 0.9).
transition(relocate, pick, transport, 0.05).
transition(relocate, pick, place, 0.05).
transition(relocate, place, still, 0.9).
transition(relocate, place, walk, 0.05).
transition(relocate, place, pick, 0.05).

% cycle(Action, N, Movement): an action has happened once these were made in order (others may lie between).
% Who transports has picked, so a pick that was overlooked does not matter.
cycle(pick_and_place, 1, transport).
cycle(pick_and_place, 2, place).
cycle(use, 1, pick).
cycle(use, 2, place).
cycle(use, 3, pick).
cycle(use, 4, place).
cycle(relocate, 1, walk).
cycle(relocate, 2, still).

% loop(Action): to go round again is still the same action.
loop(use).

% start(Action, Movement, P): with which movement an action begins.
start(pick_and_place, pick, 0.7).
start(pick_and_place, walk, 0.1).
start(pick_and_place, still, 0.1).
start(pick_and_place, transport, 0.1).
start(use, pick, 0.8).
start(use, walk, 0.1).
start(use, still, 0.1).
start(relocate, still, 0.9).
start(relocate, walk, 0.1).

% setting(actions, recogniser, hmm).              % ratcliff is the paper's
% setting(actions, filter_window, 3).             % steps whose commonest movement counts
% setting(actions, certainty, 0.6).               % hmm: the probability from which an action has happened
% setting(actions, confirm, 2).                   % hmm: steps in a row; one misread step does not decide
% setting(actions, lasts, 6.0).                   % hmm: mean seconds of a movement
% setting(actions, again, 0.5).                   % hmm: at a change of movement, that an accepted loop goes on
% setting(actions, error, 0.1).                   % hmm: of the classifier, where no emission(True, Seen, P) is known
% setting(actions, length, 6).                    % ratcliff: movements of a chain
% setting(actions, mode, argmax).                 % ratcliff: or sample, or mean
% setting(actions, letters, own).                 % ratcliff: first makes pick and place alike, as in the paper's figure
% setting(actions, threshold, 0.7).               % ratcliff: of the winner's score
