"""`xavi bench foreign`: driving on networks from elsewhere, beside SUMO's own driver."""
