"""Acts: propositions, questions and acts, grounded part by part."""
