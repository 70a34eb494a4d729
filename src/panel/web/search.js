// A field that leaves of a list what has all the words typed into it.

// The test of a text that the words make: each in any place, in any case.
export function matcher(typed) {
  const words = typed.toLowerCase().split(/\s+/).filter(Boolean);
  return (text) => {
    const low = text.toLowerCase();
    return words.every((word) => low.includes(word));
  };
}

export class Search {
  // onChange() when something else is typed.
  constructor(field, onChange) {
    this.matches = matcher("");
    field.addEventListener("input", () => {
      this.matches = matcher(field.value);
      onChange();
    });
    field.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      field.value = "";
      this.matches = matcher("");
      onChange();
    });
  }
}
