// The browser's memory of the page: choices across visits, and the name of this tab across reloads.

/** A choice of an earlier visit; null: there is none. */
export const stored = (name: string): string | null => {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
};
export const store = (name: string, value: string): void => {
  try {
    localStorage.setItem(name, value);
  } catch {
    // Private windows may refuse; then the choice holds for this visit alone.
  }
};

/** The name of this tab at the server. Undo belongs to it, so that it goes on after a reload. */
export const author = ((): string => {
  const fresh = `tab-${crypto.getRandomValues(new Uint32Array(1))[0]!.toString(36)}`;
  try {
    const kept = sessionStorage.getItem('author') ?? fresh;
    sessionStorage.setItem('author', kept);
    return kept;
  } catch {
    return fresh;
  }
})();
