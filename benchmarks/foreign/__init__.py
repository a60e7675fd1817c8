"""`xavi bench foreign`: driving on networks that nobody here made, beside SUMO's own driver."""
