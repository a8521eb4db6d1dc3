// What of a plot is read out: what a mouse points at, a finger touches or draws along, or arrow keys reach. Escape lets go.

// `nearest(x, y)` is the item at a place in the frame, `count()` how many there are; `moved()` is called when `at`, the
// item's number or null, has changed.
export function cursor(frame, { nearest, count, moved }) {
  const state = { at: null };
  const go = (to) => {
    if (to === state.at) return;
    state.at = to;
    moved();
  };
  for (const kind of ['pointermove', 'pointerdown']) {
    frame.addEventListener(kind, (event) => {
      const r = frame.getBoundingClientRect();
      if (count() > 0) go(nearest(event.clientX - r.left, event.clientY - r.top));
    });
  }
  frame.addEventListener('keydown', (event) => {
    const last = count() - 1, { at } = state;
    if (event.ctrlKey || event.altKey || event.metaKey || last < 0) return;
    const to = { ArrowRight: at === null ? 0 : Math.min(last, at + 1), ArrowLeft: at === null ? last : Math.max(0, at - 1),
      Home: 0, End: last, Escape: null }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    go(to);
  });
  return state;
}
