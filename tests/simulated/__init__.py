"""A simulated world: service, car, chats, dashboard, store and bus in one thread, by one seed."""
