% Which movement it is, learned in this kitchen: casper train kitchen writes them anew.

:- include("household/movements.pl").
