// What the keys do, and where to read on: opened by ? and by the button in the bar.
import { byId, focusWants } from "./dom.js";

export function makeHelp() {
  const dialog = byId("help");
  const open = () => dialog.open || dialog.showModal();
  byId("help-open").addEventListener("click", open);
  byId("help-close").addEventListener("click", () => dialog.close());
  // A click beside it.
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  window.addEventListener("keydown", (event) => {
    if (event.key !== "?" || focusWants(event)) return;
    event.preventDefault();
    open();
  });
}
