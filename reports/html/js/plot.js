// Pictures of the expected and the captured primitives, side by side and on the same scale.

// The parser supplies the namespace, so that the page contains no address.
const svgNames = new DOMParser().parseFromString('<svg></svg>', 'text/html').querySelector('svg').namespaceURI;
const svg = (tag, attributes, ...children) => {
  const out = document.createElementNS(svgNames, tag);
  for (const [name, value] of Object.entries(attributes)) out.setAttribute(name, value);
  out.append(...children.flat(Infinity));
  return out;
};

// Returns the mode and the points in the plane of each line like "GL_LINES 0 0 0 1 1 0"; a third of z is added to x
// and to y.
function plottedPrimitives(string) {
  return string.split('\n').filter(Boolean).map((line) => {
    const [mode, ...numbers] = line.split(' '), points = [];
    for (let i = 0; i + 2 < numbers.length; i += 3) {
      const [x, y, z] = numbers.slice(i, i + 3).map(Number);
      points.push([x + z / 3, y + z / 3]);
    }
    return {mode: mode.replace('GL_', ''), points};
  });
}

// Returns the edges of a primitive of n vertices as pairs of indices.
function edgesOf(mode, n) {
  const edges = [], chain = (first, last, step) => { for (let i = first; i + step <= last; ++i) edges.push([i, i + step]); };
  const rings = (size) => {
    for (let first = 0; first + size <= n; first += size)
      for (let i = 0; i < size; ++i) edges.push([first + i, first + (i + 1) % size]);
  };
  if (mode === 'LINES') rings(2);
  if (['LINE_STRIP', 'LINE_LOOP', 'POLYGON', 'TRIANGLE_STRIP', 'TRIANGLE_FAN'].includes(mode)) chain(0, n - 1, 1);
  if (['LINE_LOOP', 'POLYGON'].includes(mode) && n > 2) edges.push([n - 1, 0]);
  if (mode === 'TRIANGLES') rings(3);
  if (mode === 'QUADS') rings(4);
  if (mode === 'TRIANGLE_STRIP') chain(0, n - 1, 2);
  if (mode === 'TRIANGLE_FAN') for (let i = 2; i < n; ++i) edges.push([0, i]);
  if (mode === 'QUAD_STRIP') {
    chain(0, n - 1, 2);
    for (let i = 0; i + 1 < n; i += 2) edges.push([i, i + 1]);
  }
  return edges;
}

const isFinitePoint = (point) => point.every(Number.isFinite);

// Returns "2 LINE_STRIP, 5 vertices" and, if there are any, the number of vertices that are not finite.
function contentOf(primitives) {
  const points = primitives.flatMap((primitive) => primitive.points), modes = groupsBy(primitives, (primitive) => primitive.mode);
  const lost = points.filter((point) => !isFinitePoint(point)).length;
  return [...[...modes].map(([mode, some]) => `${some.length} ${mode}`), count(points.length, 'vertex').replace('vertexs', 'vertices'),
          lost ? `${lost} not finite` : ''].filter(Boolean).join(', ');
}

const panelOf = (picture, name, content) => el('figure', null, picture, el('figcaption', null, `${name}: ${content}`));

// "x y width height rrggbb... rrggbb..." as pixels with the colours of both sides.
function plottedPixels(string) {
  return string.split('\n').flatMap((line) => {
    const [x, y, width, , expected, captured] = line.split(' '), pixels = [];
    for (let i = 0; i < expected.length / 6; ++i) {
      const [a, b] = [expected, captured].map((colours) => `#${colours.slice(6 * i, 6 * i + 6)}`);
      pixels.push({x: Number(x) + i % Number(width), y: Number(y) + Math.floor(i / Number(width)), expected: a, captured: b});
    }
    return pixels;
  });
}

// The colours of both sides, and the pixels where they differ. Pixels at which the test does not look stay empty.
function pixelPlotOf(pixels, isCut) {
  const [xs, ys] = [pixels.map((pixel) => pixel.x), pixels.map((pixel) => pixel.y)];
  const [left, bottom] = [Math.min(...xs) - 1, Math.min(...ys) - 1];
  const [width, height] = [Math.max(...xs) - left + 2, Math.max(...ys) - bottom + 2];
  const levels = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  // A difference that the eye does not see is none.
  const differs = ({expected, captured}) => levels(expected).some((level, i) => Math.abs(level - levels(captured)[i]) > 5);
  const different = pixels.filter(differs);
  const drawn = (name, some, colourOf, content) => {
    const canvas = el('canvas', {width, height, role: 'img', 'aria-label': `${name}: ${content}`}), context = canvas.getContext('2d');
    for (const pixel of some) {
      context.fillStyle = colourOf(pixel);
      context.fillRect(pixel.x - left, height - 1 - (pixel.y - bottom), 1, 1);
    }
    return panelOf(canvas, name, content);
  };
  const looked = count(pixels.length, 'pixel');
  return [el('div', {class: 'plot'}, drawn('Expected', pixels, (pixel) => pixel.expected, looked),
             drawn('Captured', pixels, (pixel) => pixel.captured, looked),
             drawn('Different', different, () => '#c22', different.length ? `${different.length} of ${looked}` : 'none by more than 5 of 255')),
          el('p', {class: 'faint'}, ['Pixels at which the test looks, enlarged.', isCut ? 'The first pixels only.' : ''].filter(Boolean).join(' '))];
}

function plotOf(failure) {
  const plot = data.plots[failure[PLOT]];
  if (!plot.length) return null;
  if (plot[3]) return pixelPlotOf(plottedPixels(plot[3]), plot[2]);
  const isJudgedByRule = plot[0] === null, [expected, captured] = [plot[0] ?? '', plot[1]].map(plottedPrimitives);
  const pointsOf = (primitives) => primitives.flatMap((primitive) => primitive.points).filter(isFinitePoint);
  const all = [...pointsOf(expected), ...pointsOf(captured)];
  if (!all.length) return null;
  const low = [0, 1].map((axis) => Math.min(...all.map((point) => point[axis])));
  const high = [0, 1].map((axis) => Math.max(...all.map((point) => point[axis])));
  const size = Math.max(high[0] - low[0], high[1] - low[1]) || 1;
  const scale = 184 / size, extents = [0, 1].map((axis) => Math.max(16 + scale * (high[axis] - low[axis]), 50));
  const place = (point) => [0, 1].map((axis) => {
    const offset = scale * (point[axis] - (low[axis] + high[axis]) / 2);
    return extents[axis] / 2 + (axis ? -offset : offset);
  });
  // A captured vertex is wrong if no vertex is expected at its place.
  const wanted = pointsOf(expected);
  const isWrong = ([x, y]) => !wanted.some(([a, b]) => Math.hypot(a - x, b - y) <= 1e-3 * size);

  const drawn = (primitives, mark) => primitives.map(({mode, points}) => [
    edgesOf(mode, points.length).filter((edge) => edge.every((i) => isFinitePoint(points[i]))).map(([a, b]) => {
      const [[x1, y1], [x2, y2]] = [place(points[a]), place(points[b])];
      return svg('line', {x1, y1, x2, y2});
    }),
    points.filter(isFinitePoint).map((point) => {
      const [cx, cy] = place(point);
      return svg('circle', {cx, cy, r: 3, class: mark && isWrong(point) ? 'wrong' : 'right'});
    })]);
  const panel = (name, primitives, mark) => panelOf(
      svg('svg', {viewBox: `0 0 ${extents[0]} ${extents[1]}`, role: 'img', 'aria-label': `${name}: ${contentOf(primitives)}`}, drawn(primitives, mark)),
      name, contentOf(primitives));
  if (isJudgedByRule) {
    // A single point shows nothing.
    if (all.length < 2) return null;
    return [el('div', {class: 'plot'}, panel('Captured', captured, false)), plot[2] ? el('p', {class: 'faint'}, 'The first vertices only.') : null];
  }
  const wrong = captured.flatMap((primitive) => primitive.points).filter((point) => isFinitePoint(point) && isWrong(point)).length;
  return [el('div', {class: 'plot'}, panel('Expected', expected, false), panel('Captured', captured, true)),
          el('p', {class: 'faint'}, [wrong ? 'Captured vertices where none is expected are filled.' : '',
                                     plot[2] ? 'The first vertices only.' : ''].filter(Boolean).join(' '))];
}
