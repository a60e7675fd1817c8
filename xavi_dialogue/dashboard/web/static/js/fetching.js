/** GET of JSON from this server. */

const PATIENCE = 20_000; // [ms]

/**
 * @param {string} path
 * @returns {Promise<any>}
 * @throws {Error} with words for people, and the response's `status` where there was one
 */
export async function fetchJson(path) {
  const asked = { headers: { accept: "application/json" }, signal: AbortSignal.timeout(PATIENCE) };
  const response = await fetch(path, asked).catch(() => {
    throw new Error("The dashboard does not answer.");
  });
  const body = await response.json().catch(() => null);
  if (response.ok && body !== null) return body;
  const words = typeof body?.error === "string" ? body.error : "The dashboard did not say what was asked for.";
  throw Object.assign(new Error(words), { status: response.status });
}
