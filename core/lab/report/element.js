// Makes elements, so that text is always text and never markup.

const SVG = 'http://www.w3.org/2000/svg';

function fill(made, properties, children) {
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
}

export function element(tag, properties = {}, ...children) {
  return fill(document.createElement(tag), properties, children);
}

export function drawn(tag, properties = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), properties, children);
}

// A name that may be broken after what joins its parts, rather than inside a word.
export function breakable(name) {
  return name.split(/(?<=[_=,+/:-])(?=[^_=,+/:-])/).flatMap((part, i) => (i ? [element('wbr'), part] : [part]));
}

// A labelled <select>. `options` are [value, text]; `chosen` is called with the value.
export function choice(label, options, chosen, value) {
  const select = element('select', { onchange: () => chosen(select.value) },
    options.map(([key, text]) => element('option', { value: key }, text)));
  if (value !== undefined) select.value = value;
  return { root: element('label', { class: 'field' }, element('span', {}, label), select), select };
}
