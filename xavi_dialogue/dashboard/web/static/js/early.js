// Runs before anything is drawn, so that a chosen theme does not flash up as the other one.
try {
  const theme = localStorage.getItem("xavi-theme");
  if (theme === "light" || theme === "dark") document.documentElement.dataset.theme = theme;
} catch {
  // No storage: the system's theme.
}
