/** GET of JSON from this server. */

const PATIENCE = 20_000; // [ms]

/**
 * @param {string} path
 * @returns {Promise<any>}
 * @throws {Error} with words for people
 */
export async function fetchJson(path) {
  const response = await fetch(path, { headers: { accept: "application/json" }, signal: AbortSignal.timeout(PATIENCE) });
  const body = await response.json().catch(() => null);
  if (response.ok && body !== null) return body;
  throw new Error(typeof body?.error === "string" ? body.error : "The dashboard did not say what was asked for.");
}
