// What is the same at the next visit.

/** What was kept. A browser that keeps nothing has nothing; asking it may even be forbidden. */
export function kept(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

/** Keeps it where the browser does. */
export function keep(name, value) {
  try {
    localStorage.setItem(name, value);
  } catch {}
}
