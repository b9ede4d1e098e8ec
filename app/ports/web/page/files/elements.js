// Elements with properties and children; text is never read as HTML.
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

// Writes only what is new, so that nothing selected or read aloud is disturbed.
export function setText(where, text) {
  if (where.textContent !== text) where.textContent = text;
}
