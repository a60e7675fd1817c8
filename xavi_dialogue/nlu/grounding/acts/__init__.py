"""Acts: times, events, propositions, questions and acts, grounded part by part."""
