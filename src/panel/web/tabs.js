// Tabs as ARIA has them: arrow keys go along, the chosen one alone is in the order of Tab.
export function makeTabs(list, onChange) {
  const tabs = [...list.querySelectorAll("[role=tab]")];
  const choose = (chosen, focus) => {
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", tab === chosen);
      tab.tabIndex = tab === chosen ? 0 : -1;
    }
    document.body.dataset.tab = chosen.dataset.tab;
    sessionStorage.setItem("tab", chosen.dataset.tab);
    if (focus) chosen.focus();
    onChange();
  };
  for (const tab of tabs) {
    tab.addEventListener("click", () => choose(tab, false));
    tab.addEventListener("keydown", (event) => {
      const shown = tabs.filter((other) => other.offsetParent);
      const at = shown.indexOf(tab);
      const last = shown.length - 1;
      const to = { ArrowRight: at + 1, ArrowLeft: at + last, Home: 0, End: last }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      choose(shown[to % shown.length], true);
    });
  }
  const named = (name) => tabs.find((tab) => tab.dataset.tab === name);
  choose(named(sessionStorage.getItem("tab")) ?? named("remote"), false);
  // On a wide page two of them are not there: what they show is, all the time.
  const settle = () => {
    if (!named(document.body.dataset.tab).offsetParent) choose(named("remote"), false);
  };
  window.addEventListener("resize", settle);
  settle();
}
