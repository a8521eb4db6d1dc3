// The images: before and after a divider, all variants side by side, one view, one exposure, one frame for all.
import { divider } from './divider.js';
import { choice, element } from './element.js';
import { number_text } from './numbers.js';
import { Pane } from './pane.js';
import { Tone, map_colour, picture_of } from './pixels.js';
import { title_of } from './results.js';
import { legend, look } from './state.js';
import { steer } from './steer.js';
import { View } from './view.js';

// What a pane can show: the input, each variant, the reference. Names of variants cannot clash with these ids.
function subjects(results, sequence) {
  const has = (kind, variant) => results.images.some((i) => i.kind === kind && i.variant === variant
    && i.sequence === sequence);
  const list = [];
  if (has('input', '')) list.push({ id: 'input:', kind: 'input', variant: '', title: 'Input' });
  for (const v of results.variants) {
    if (has('image', v.name)) list.push({ id: `image:${v.name}`, kind: 'image', variant: v.name, title: v.name });
  }
  if (has('reference', '')) list.push({ id: 'reference:', kind: 'reference', variant: '', title: 'Reference' });
  return list;
}

function colour_scale() {
  const strip = element('canvas', { width: 256, height: 1, 'aria-hidden': 'true' });
  const context = strip.getContext('2d'), image = context.createImageData(256, 1);
  for (let i = 0; i < 256; ++i) image.data.set([...map_colour(i / 255), 255], 4 * i);
  context.putImageData(image, 0, 0);
  const low = element('span'), high = element('span');
  const root = element('div', { class: 'colour-scale', hidden: true }, low, strip, high);
  return { root, set(tone) { low.textContent = number_text(tone.low); high.textContent = `≥ ${number_text(tone.high)}`; } };
}

export function viewer_section(results, shown) {
  const section = document.getElementById('images');
  const sequences = results.sequences.filter((s) => subjects(results, s.name).length);
  if (!sequences.length) {
    section.append(element('p', {}, 'This report carries no images.'));
    return;
  }
  const view = new View(), stage = new Pane(view, 'Before and after');
  const stage_root = element('div', { class: 'stage' }, stage.canvas, divider(stage));
  steer(stage_root, stage);
  const status = element('p', { class: 'visually-hidden', role: 'status' });
  const scale = colour_scale(), grid = element('div', { class: 'grid' });
  let tiles = [], frames = [], turn = 0;

  const sequence = () => pick_sequence.select.value;
  const frame = () => frames[Number(scrub.value)];
  const map = () => pick_show.select.value;  // '' or the metric whose error map is shown
  const entry = (subject) => (map() === '' ? results.picture(subject.kind, subject.variant, sequence(), '', frame())
    : results.picture('map', subject.variant, sequence(), map(), frame()));

  // One scale for all variants and frames, so that colours can be compared: that of the middle map, so that a baseline
  // far off does not leave the others black.
  function tone() {
    const stops = Number(exposure.value);
    if (map() === '') return new Tone(stops, 0, 1);
    const maps = results.images.filter((i) => i.kind === 'map' && i.metric === map() && i.sequence === sequence());
    const middle = (values) => values.toSorted((a, b) => a - b)[(values.length - 1) >> 1];
    return new Tone(stops, Math.min(0, middle(maps.map((i) => i.low))), middle(maps.map((i) => i.high)) || 1);
  }

  function number_of(subject) {
    const metric = results.metric(map() || pick_metric.select.value);
    if (subject.kind !== 'image' || !metric) return '';
    const value = results.value_at(subject.variant, sequence(), metric.name, frame());
    return value === null ? '' : `${title_of(metric)} ${number_text(value)}${metric.unit ? ` ${metric.unit}` : ''}`;
  }

  async function load() {
    const mine = ++turn, now = tone();
    const chosen = (id) => tiles.find((t) => t.subject.id === id).subject;
    const wanted = [...tiles.filter((t) => !t.root.hidden).map((t) => [t.pane, [t.subject]]),
      [stage, [chosen(before.select.value), chosen(after.select.value)]]];
    // A frame may lack an image, as references are often of a few frames only.
    const decode = (subject) => (entry(subject) ? picture_of(entry(subject)) : undefined);
    // All that is in view changes at once.
    const fill = async (panes) => {
      const ready = await Promise.all(panes.map(async ([pane, list]) => [pane, await Promise.all(list.map(decode))]));
      if (mine !== turn) return false;  // something else is wanted by now
      for (const [pane, pictures] of ready) pane.show(pictures, now);
      read_out();
      return true;
    };
    const near = wanted.filter(([pane]) => pane.near);
    for (const one of wanted) if (!near.includes(one)) one[0].when_near(() => fill([one]));
    if (!await fill(near)) return;
    for (const t of tiles) t.number.textContent = number_of(t.subject);
    frame_text.textContent = String(frame());
    place_text.textContent = ` ${Number(scrub.value) + 1} of ${frames.length}`;
    stops_text.textContent = `${now.stops > 0 ? '+' : ''}${now.stops.toFixed(1)} EV`;
    scrub.setAttribute('aria-valuetext', `frame ${frame()},${place_text.textContent}`);
    exposure.setAttribute('aria-valuetext', stops_text.textContent);
    scale.root.hidden = map() === '';
    scale.set(now);
    status.textContent = `Frame ${frame()} of ${sequence()} is shown`;
    section.dataset.shown = [sequence(), map(), frame(), exposure.value].join(' ');
  }

  function read_out() {
    for (const t of tiles) {
      const { picture } = t.pane;
      const inside = picture && view.pixel && view.pixel[0] < picture.width && view.pixel[1] < picture.height;
      t.value.textContent = inside ? picture.at(...view.pixel).map(number_text).join('  ') : '';
    }
    zoom_text.textContent = `×${view.zoom.toFixed(view.zoom < 10 ? 1 : 0)}`;
    if (document.activeElement !== pixel_x && document.activeElement !== pixel_y) {
      [pixel_x.value, pixel_y.value] = view.pixel ?? ['', ''];
    }
  }

  function make_tiles() {
    const { width, height } = results.images.find((i) => i.sequence === sequence());
    stage.shape(width, height);
    stage_root.style.setProperty('--shape', width / height);
    tiles = subjects(results, sequence()).map((subject) => {
      const pane = new Pane(view, subject.title);
      pane.shape(width, height);
      steer(pane.canvas, pane);
      const numbers = element('span', { class: 'note' }), value = element('div', { class: 'value' });
      const place = results.place(subject.variant);
      const root = element('figure', { class: place === undefined ? 'other' : look(place), 'data-subject': subject.id },
        element('figcaption', {}, element('span', { class: 'swatch', 'aria-hidden': 'true' }),
          element('strong', {}, subject.title), numbers), pane.canvas, value);
      return { subject, pane, root, number: numbers, value };
    });
    grid.replaceChildren(...tiles.map((t) => t.root));
    frames = results.sequences.find((s) => s.name === sequence()).frames.filter((f) =>
      results.images.some((i) => i.sequence === sequence() && i.frame === f));
    scrub.max = frames.length - 1;
    scrub.value = frames.length - 1;
    const maps = [...new Set(results.images.filter((i) => i.kind === 'map' && i.sequence === sequence())
      .map((i) => i.metric))];
    pick_show.select.replaceChildren(element('option', { value: '' }, 'Images'),
      ...maps.map((m) => element('option', { value: m }, `Error map: ${title_of(results.metric(m) ?? { name: m })}`)));
    show_tiles();
  }

  // The choice stays where it can.
  function offer(select, place) {
    const before_that = select.value, offered = tiles.filter(has_shown);
    select.replaceChildren(...offered.map((t) => element('option', { value: t.subject.id }, t.subject.title)));
    const same = offered.findIndex((t) => t.subject.id === before_that);
    select.selectedIndex = same >= 0 ? same : Math.min(place, offered.length - 1);
  }

  // Input and reference have no error map.
  function has_shown(tile) {
    return tile.subject.kind === 'image' || map() === '';
  }

  function show_tiles() {
    for (const t of tiles) {
      t.root.hidden = !has_shown(t) || (t.subject.kind === 'image' && !shown.has(t.subject.variant));
    }
    offer(before.select, 0);
    offer(after.select, 1);
    if (after.select.value === before.select.value) {
      after.select.selectedIndex = (after.select.selectedIndex + 1) % after.select.options.length;
    }
    pick_metric.root.hidden = map() !== '';
    load();
  }

  const slider = (label, properties, text, changed) => {
    const input = element('input', { type: 'range', oninput: changed, 'aria-label': label, ...properties });
    return [input, element('label', { class: 'field slide' }, element('span', {}, label, ' ', ...[text].flat()), input)];
  };
  const frame_text = element('b'), place_text = element('span'), stops_text = element('b'), zoom_text = element('output');
  const pick_sequence = choice('Sequence', sequences.map((s) => [s.name, s.name]), () => { view.read(null); make_tiles(); });
  const pick_show = choice('Show', [['', 'Images']], show_tiles);
  const pick_metric = choice('Number', results.metrics.map((m) => [m.name, title_of(m)]), load);
  const [scrub, scrub_field] = slider('Frame', { min: 0, max: 0, step: 1, id: 'frame' }, [frame_text, place_text], load);
  const [exposure, exposure_field] = slider('Exposure', { min: -8, max: 8, step: 0.1, value: 0, id: 'exposure' },
    stops_text, load);
  const before = choice('Before', [], load), after = choice('After', [], load);
  const button = (text, label, act) => element('button', { type: 'button', 'aria-label': label, title: label,
    onclick: act }, text);
  const pixel_of = () => {
    const picture = tiles.find((t) => t.pane.picture)?.pane.picture;
    if (!picture || pixel_x.value === '' || pixel_y.value === '') return;
    const within = (text, size) => Math.max(0, Math.min(size - 1, Math.floor(Number(text))));
    view.read([within(pixel_x.value, picture.width), within(pixel_y.value, picture.height)]);
  };
  const pixel_x = element('input', { type: 'number', min: 0, id: 'pixel-x', oninput: pixel_of });
  const pixel_y = element('input', { type: 'number', min: 0, id: 'pixel-y', oninput: pixel_of });
  const zoom = element('div', { class: 'field zoom', role: 'group', 'aria-label': 'Zoom' },
    element('span', {}, 'Zoom ', zoom_text), element('span', { class: 'buttons' },
      button('−', 'Zoom out', () => view.zoom_out()), button('+', 'Zoom in', () => view.zoom_in()),
      button('Fit', 'Show the whole image', () => view.fit())));
  const pixel = element('div', { class: 'field pixel', role: 'group', 'aria-label': 'Pixel that is read out' },
    element('span', {}, 'Pixel'), element('span', { class: 'buttons' },
      element('label', {}, 'x ', pixel_x), element('label', {}, 'y ', pixel_y)));

  view.listen(() => {
    for (const t of tiles) t.pane.draw();
    stage.draw();
    read_out();
  });
  shown.listen(show_tiles);
  section.append(
    element('div', { class: 'bar controls' }, element('div', { class: 'bar' }, pick_sequence.root, pick_show.root),
      element('div', { class: 'bar sliders' }, scrub_field, exposure_field, zoom), pixel),
    scale.root,
    element('p', { class: 'hint', id: 'steering' },
      element('span', { class: 'by-mouse' }, 'Click an image, then the wheel or + and − zoom, dragging or arrow keys pan, ',
        '0 shows all of it, Escape lets go; every image follows.'),
      element('span', { class: 'by-finger' }, 'Two fingers zoom, then one pans; a tap reads a pixel. Every image follows.')),
    element('h3', {}, 'Before and after'),
    element('div', { class: 'bar' }, before.root, after.root),
    stage_root,
    element('h3', {}, 'Side by side'),
    element('div', { class: 'bar' }, pick_metric.root), legend(shown).root, grid, status);
  make_tiles();
}
