/** The dialog that tells the keys. */
import { partsOf } from "./dom.js";
import { recall, remember } from "./remembered.js";

const KEY = "xavi-keys";

/**
 * @param {HTMLDialogElement} dialog
 * @returns {{open: () => void, singleKeys: () => boolean}}
 */
export function createHelp(dialog) {
  const { singleKeys, close } = partsOf(dialog);
  singleKeys.checked = recall(KEY) !== "off";
  singleKeys.addEventListener("change", () => remember(KEY, singleKeys.checked ? null : "off"));
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close()); // beside it
  return { open: () => dialog.open || dialog.showModal(), singleKeys: () => singleKeys.checked };
}
