"""`xavi bench foreign`: driving on other networks, compared with SUMO's own driver."""
