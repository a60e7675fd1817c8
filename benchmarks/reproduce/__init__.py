"""The paper's Tables 1 to 3, compared with our answers about the same stories."""
