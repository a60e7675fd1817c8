"""The paper's Tables 1 to 3, beside what we say of the same stories."""
