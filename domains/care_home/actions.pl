% How actions are made out comes from the shipped library; here is what a use means where.
:- include("household.pl").

context(use, tray, eat).
context(use, basin, wash).
context(use, pad, measure).
context(use, saucer, take).
context(use, lectern, read).
