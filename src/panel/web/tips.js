// Titles for those who have no mouse: a finger that rests on something shows its title.
const REST = 450; // ms; *assumed*, as the next
const SHOWN = 4000; // ms

export function showTips(bubble) {
  let timer = 0;
  const hide = () => {
    clearTimeout(timer);
    bubble.hidden = true;
  };
  const tell = (node) => {
    bubble.textContent = node.title;
    bubble.hidden = false;
    const box = node.getBoundingClientRect();
    const own = bubble.getBoundingClientRect();
    const left = Math.max(8, Math.min(box.left, innerWidth - own.width - 8));
    const above = box.top - own.height - 8;
    bubble.style.transform = `translate(${left}px, ${above > 8 ? above : box.bottom + 8}px)`;
    timer = setTimeout(hide, SHOWN);
  };
  document.addEventListener("pointerdown", (event) => {
    hide();
    if (event.pointerType !== "touch") return;
    const node = event.target.closest("[title]");
    if (node?.title) timer = setTimeout(() => tell(node), REST);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    document.addEventListener(end, () => bubble.hidden && clearTimeout(timer));
  }
  document.addEventListener("scroll", hide, { capture: true, passive: true });
}
