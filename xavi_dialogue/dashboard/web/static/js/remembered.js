/** What this browser remembers of its reader; nothing, where it may not. */

/** @returns {string|null} */
export function recall(key, storage = () => localStorage) {
  try {
    return storage().getItem(key);
  } catch {
    return null; // forbidden by the browser's settings
  }
}

/** Remember a text; null forgets it. */
export function remember(key, value, storage = () => localStorage) {
  try {
    if (value === null) storage().removeItem(key);
    else storage().setItem(key, value);
  } catch {
    // Then it lasts as long as the page.
  }
}

/** The storage that ends with the tab. */
export const ofTab = () => sessionStorage;
