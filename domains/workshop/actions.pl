% How actions are made out comes from the shipped library; here is what a use means where.
:- include("household.pl").

context(use, saw,    cut).
context(use, drill,  bore).
context(use, press,  rivet).
context(use, gluing, glue).
context(use, oven,   bake).
