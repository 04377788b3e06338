:- include("household.pl").    % how movements and actions are made out, from the shipped library
context(use, tray, drink).     % what using something means at a place
