"""Plan recognition: engines that give the same answers, and the specification that says what the answers are."""
