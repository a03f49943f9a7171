// The tissue of a report in 3-D: what C++ wrote as data, shown by three.js. Nothing is fetched, and all that is said in words stands in the page
// already. Places are millimetres in the mesh's frame.
(() => {
'use strict';

const run = JSON.parse(document.getElementById('run-data').textContent);
const T = window.PalpationThree;
const byId = (id) => document.getElementById(id);

// Those of the pictures (colour.cpp): told apart also by people who confuse red and green.
const PALETTES = {
  mean: [[33, 61, 138], [67, 112, 190], [132, 170, 219], [200, 217, 238], [252, 252, 252], [246, 207, 190], [228, 146, 122], [197, 76, 68], [138, 19, 41]],
  stddev: [[68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128], [94, 201, 98], [173, 220, 48], [253, 231, 37]],
  probability_inside: [[252, 251, 253], [239, 237, 245], [218, 218, 235], [188, 189, 220], [158, 154, 200], [128, 125, 186], [106, 81, 163], [84, 39, 143],
    [63, 0, 125]],
};
const LINES = {
  estimate: {colour: 0x26262a, width: 2.6, halo: true},
  truth: {colour: 0x006c3e, width: 2.2, dash: 0.012, halo: true},
  band_inner: {colour: 0x8a5a00, width: 1.6},
  band_outer: {colour: 0x8a5a00, width: 1.6},
  cut: {colour: 0x741e8c, width: 2.2, dash: 0.02},
};
const KIND = {stop: 0, way: 1, missed: 2, next: 3};

// ---- from text to numbers

function bytesOf(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

function field(packed) {
  if (!packed) return null;
  if (packed.bits === 32) return new Float32Array(bytesOf(packed.values));
  const whole = packed.bits === 16 ? new Uint16Array(bytesOf(packed.values)) : new Uint8Array(bytesOf(packed.values));
  const step = (packed.high - packed.low) / (packed.bits === 16 ? 65535 : 255);
  return Float32Array.from(whole, (value) => packed.low + step * value);
}

function places(text) {
  const whole = new Uint16Array(bytesOf(text));
  return Float32Array.from(whole, (value, i) => run.low[i % 3] + (run.high[i % 3] - run.low[i % 3]) * value / 65535);
}

function number(value, digits = 4) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : '';
}

// ---- what is drawn

const VERTEX = `
attribute float value; attribute float score; attribute float beyond;
varying float vValue; varying float vScore; varying float vBeyond; varying float vFacing;
void main() {
  vValue = value; vScore = score; vBeyond = beyond;
  vFacing = abs(normalize(normalMatrix * normal).z);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = `
uniform sampler2D palette; uniform float low, high, band, pixel; uniform bool showBand, showUnsearched, shade;
varying float vValue; varying float vScore; varying float vBeyond; varying float vFacing;
void main() {
  float share = clamp((vValue - low) / (high - low), 0.0, 1.0);
  vec3 colour = texture2D(palette, vec2((share * 511.0 + 0.5) / 512.0, 0.5)).rgb;
  if (showBand && abs(vScore) <= band) colour = mix(colour, vec3(0.99, 0.78, 0.30), 0.7);
  if (showUnsearched && vBeyond >= 0.0) {
    colour = mix(colour, vec3(0.86), 0.8);
    if (mod(gl_FragCoord.x + gl_FragCoord.y, 10.0 * pixel) < 1.5 * pixel) colour = vec3(0.45);
  }
  if (shade) colour *= 0.5 + 0.5 * vFacing;
  gl_FragColor = vec4(colour, 1.0);
}`;
const DOT_VERTEX = `
attribute float size; attribute vec3 rim; attribute vec3 core;
uniform float pixel;
varying vec3 vRim; varying vec3 vCore;
void main() {
  vRim = rim; vCore = core;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z -= 0.004;
  gl_PointSize = size * pixel;
}`;
const DOT_FRAGMENT = `
varying vec3 vRim; varying vec3 vCore;
void main() {
  float from = 2.0 * length(gl_PointCoord - vec2(0.5));
  if (from > 1.0) discard;
  gl_FragColor = vec4(from > 0.62 ? vRim : vCore, 1.0);
}`;

function paletteTexture(colours) {
  const size = 512, data = new Uint8Array(4 * size);
  for (let i = 0; i < size; ++i) {
    const at = i / (size - 1) * (colours.length - 1), left = Math.min(Math.floor(at), colours.length - 2);
    for (let c = 0; c < 3; ++c) data[4 * i + c] = Math.round(colours[left][c] + (at - left) * (colours[left + 1][c] - colours[left][c]));
    data[4 * i + 3] = 255;
  }
  const texture = new T.DataTexture(data, size, 1, T.RGBAFormat);
  texture.minFilter = texture.magFilter = T.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

function canDraw() {
  try {
    return document.createElement('canvas').getContext('webgl2') !== null;
  } catch {
    return false;
  }
}

if (!run.positions || !T || !canDraw()) {
  byId('no-3d').hidden = false;
  return;
}
document.documentElement.classList.add('has-3d');

const canvas = byId('tissue');
const renderer = new T.WebGLRenderer({canvas, antialias: true});
renderer.setClearColor(0xffffff);
const scene = new T.Scene();
const size = Math.hypot(...run.high.map((high, i) => high - run.low[i]));
const middle = new T.Vector3(...run.high.map((high, i) => (high + run.low[i]) / 2));

const geometry = new T.BufferGeometry();
const position = places(run.positions);
geometry.setAttribute('position', new T.BufferAttribute(position, 3));
const corners = run.vertices > 65535 ? new Uint32Array(bytesOf(run.indices)) : new Uint16Array(bytesOf(run.indices));
geometry.setIndex(new T.BufferAttribute(corners, 1));
geometry.computeVertexNormals();
const normal = geometry.getAttribute('normal').array;

const finals = {};
for (const name of Object.keys(run.fields)) finals[name] = field(run.fields[name]);
const still = new Float32Array(run.vertices);
geometry.setAttribute('value', new T.BufferAttribute(new Float32Array(finals.mean), 1));
geometry.setAttribute('score', new T.BufferAttribute(finals.score || still, 1));
geometry.setAttribute('beyond', new T.BufferAttribute(field(run.beyond), 1));

const textures = {};
for (const name of Object.keys(PALETTES)) textures[name] = paletteTexture(PALETTES[name]);
const tissueMaterial = new T.ShaderMaterial({
  vertexShader: VERTEX, fragmentShader: FRAGMENT, side: T.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4,
  uniforms: {
    palette: {value: textures.mean}, low: {value: 0}, high: {value: 1}, band: {value: run.bandScore ?? 0}, pixel: {value: 1},
    showBand: {value: false}, showUnsearched: {value: true}, shade: {value: false},
  },
});
const tissue = new T.Mesh(geometry, tissueMaterial);
scene.add(tissue);

// ---- lines

const lineMaterials = [];

function lineOf(segments, style) {
  const parts = [];
  const made = new T.LineSegmentsGeometry();
  made.setPositions(segments);
  const add = (colour, width, dash) => {
    const material = new T.LineMaterial({
      color: colour, linewidth: width, dashed: Boolean(dash), dashSize: (dash || 0) * size, gapSize: (dash || 0) * 0.7 * size, transparent: true,
    });
    material.toneMapped = false;
    material.depthWrite = false;  // or a line and its halo would hide each other where tissue bends
    lineMaterials.push(material);
    const line = new T.LineSegments2(made, material);
    if (dash) line.computeLineDistances();
    line.visible = false;
    line.renderOrder = parts.length;
    parts.push(line);
    scene.add(line);
  };
  if (style.halo) add(0xffffff, style.width + 2.6, 0);
  add(style.colour, style.width, style.dash);
  return parts;
}

function free(parts) {
  for (const part of parts) {
    scene.remove(part);
    part.geometry.dispose();
    part.material.dispose();
    lineMaterials.splice(lineMaterials.indexOf(part.material), 1);
  }
}

const lines = {};
for (const kind of Object.keys(LINES))
  if (run.lines[kind]) lines[kind] = lineOf(places(run.lines[kind]), LINES[kind]);
if (run.rim) lineOf(places(run.rim), {colour: 0x76787e, width: 1.2}).forEach((part) => { part.visible = true; });
let outlineThen = [];  // of an earlier batch
let tourNow = [];

// ---- touches

const touches = run.touches.map(([n, x, y, z, batch, kind, aside]) => ({n, place: new T.Vector3(x, y, z), batch, kind, aside}));
let dots = null;
let chosen = null;

function coloursOf(touch, isNow) {
  if (touch === chosen) return [[0.89, 0, 0.55], [1, 1, 1], 17];
  if (touch.kind === KIND.next) return [[0.89, 0, 0.55], [0.89, 0, 0.55], 10];
  if (touch.kind === KIND.missed) return [[0.15, 0.15, 0.17], [0.8, 0.8, 0.8], 9];
  if (touch.aside) return [[0.15, 0.15, 0.17], [0.96, 0.67, 0.08], 10];
  if (touch.kind === KIND.way) return [[1, 1, 1], [0.15, 0.15, 0.17], 4];
  return isNow ? [[0.15, 0.15, 0.17], [1, 1, 1], 11] : [[1, 1, 1], [0.15, 0.15, 0.17], 8];
}

function nearestVertex(place) {
  let best = 0, least = Infinity;
  for (let i = 0; i < run.vertices; ++i) {
    const dx = position[3 * i] - place.x, dy = position[3 * i + 1] - place.y, dz = position[3 * i + 2] - place.z;
    const far = dx * dx + dy * dy + dz * dz;
    if (far < least) { least = far; best = i; }
  }
  return best;
}

function normalAt(touch) {
  if (touch.normal) return touch.normal;
  const vertex = nearestVertex(touch.place);
  touch.normal = new T.Vector3(normal[3 * vertex], normal[3 * vertex + 1], normal[3 * vertex + 2]);
  return touch.normal;
}

function shownTouches() {
  const state = run.states[now];
  return touches.filter((touch) => touch.kind === KIND.next ? state.isLast : touch.batch <= state.batch);
}

function drawDots() {
  if (dots) {
    scene.remove(dots);
    dots.geometry.dispose();
  }
  const shown = byId('show-touches').checked ? shownTouches() : chosen ? [chosen] : [];
  const made = new T.BufferGeometry(), place = [], rim = [], core = [], sizes = [];
  for (const touch of shown) {
    const [outer, inner, width] = coloursOf(touch, touch.batch === run.states[now].batch);
    place.push(touch.place.x, touch.place.y, touch.place.z);
    rim.push(...outer);
    core.push(...inner);
    sizes.push(width);
  }
  made.setAttribute('position', new T.BufferAttribute(new Float32Array(place), 3));
  made.setAttribute('rim', new T.BufferAttribute(new Float32Array(rim), 3));
  made.setAttribute('core', new T.BufferAttribute(new Float32Array(core), 3));
  made.setAttribute('size', new T.BufferAttribute(new Float32Array(sizes), 1));
  dots = new T.Points(made, dotMaterial);
  dots.frustumCulled = false;
  dots.renderOrder = 20;
  scene.add(dots);
}
const dotMaterial = new T.ShaderMaterial({vertexShader: DOT_VERTEX, fragmentShader: DOT_FRAGMENT, transparent: true, uniforms: {pixel: {value: 1}}});

// ---- the view

const camera = new T.OrthographicCamera(-1, 1, 1, -1, 0.01, 1);
const controls = new T.OrbitControls(camera, canvas);
controls.zoomToCursor = true;

/** Towards the viewer: the mean normal of what is probably tumour, else of all; x to the right as far as that is possible (as in the pictures). */
function facing() {
  const p = finals.probability_inside, sum = new T.Vector3(), all = new T.Vector3();
  const a = new T.Vector3(), b = new T.Vector3(), c = new T.Vector3();
  let area = 0, part = 0;
  for (let i = 0; i < corners.length; i += 3) {
    const [u, v, w] = [corners[i], corners[i + 1], corners[i + 2]];
    a.fromArray(position, 3 * u);
    b.fromArray(position, 3 * v).sub(a);
    c.fromArray(position, 3 * w).sub(a);
    b.cross(c);
    all.add(b);
    area += b.length();
    if (p && p[u] >= 0.5 && p[v] >= 0.5 && p[w] >= 0.5) {
      sum.add(b);
      part += b.length();
    }
  }
  const planar = all.length() > (1 - 1e-6) * area;
  if (!planar && part > 0 && sum.length() > 0.05 * part) return sum.normalize();
  return all.length() > 0.05 * area ? all.normalize() : new T.Vector3(0, 0, 1);
}
const towards = facing();
const axis = Math.abs(towards.x) > 0.985 ? new T.Vector3(0, 1, 0) : new T.Vector3(1, 0, 0);
const right = axis.clone().addScaledVector(towards, -towards.dot(axis)).normalize();
const up = towards.clone().cross(right);

function resetView() {
  camera.up.copy(up);
  camera.zoom = 1;
  controls.target.copy(middle);
  camera.position.copy(middle).addScaledVector(towards, 2 * size);
  camera.near = 0.01 * size;
  camera.far = 6 * size;
  camera.lookAt(middle);
  fit();
  controls.update();
  draw();
}

/** So that all of the tissue is in the window, seen from the front. */
function fit() {
  const width = canvas.clientWidth || 1, height = canvas.clientHeight || 1;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 3));
  renderer.setSize(width, height, false);
  let w = 0, h = 0;
  const place = new T.Vector3();
  for (let i = 0; i < run.vertices; ++i) {
    place.fromArray(position, 3 * i).sub(middle);
    w = Math.max(w, Math.abs(place.dot(right)));
    h = Math.max(h, Math.abs(place.dot(up)));
  }
  const half = 1.06 * Math.max(h, w * height / width, 1e-6);
  camera.top = half;
  camera.bottom = -half;
  camera.right = half * width / height;
  camera.left = -camera.right;
  camera.updateProjectionMatrix();
  const pixel = renderer.getPixelRatio();
  tissueMaterial.uniforms.pixel.value = dotMaterial.uniforms.pixel.value = pixel;
}

function drawScaleBar() {
  const mm = (camera.right - camera.left) / camera.zoom / (canvas.clientWidth || 1);  // of a pixel
  const most = 140 * mm, power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((digit) => digit * power).find((one) => one <= most) || power;
  byId('scale-line').style.width = `${length / mm}px`;
  byId('scale-words').textContent = `${number(length, 3)} mm`;
}

const labels = byId('labels');
function drawLabels() {
  const shown = byId('show-numbers').checked && byId('show-touches').checked
    ? shownTouches().filter((touch) => touch.kind !== KIND.way && (touch.kind === KIND.next || touch.batch === run.states[now].batch || touch === chosen)) : [];
  while (labels.childElementCount > shown.length) labels.lastChild.remove();
  while (labels.childElementCount < shown.length) labels.append(document.createElement('span'));
  const view = camera.position.clone().sub(controls.target).normalize(), place = new T.Vector3();
  const taken = [];
  shown.forEach((touch, i) => {
    const label = labels.children[i];
    place.copy(touch.place).project(camera);
    label.textContent = touch.kind === KIND.next ? `+${touch.n}` : touch.n;
    label.hidden = Math.abs(place.x) > 1 || Math.abs(place.y) > 1 || normalAt(touch).dot(view) < 0.02;
    if (label.hidden) return;
    const [left, top] = freePlace((place.x + 1) / 2 * canvas.clientWidth, (1 - place.y) / 2 * canvas.clientHeight, label.textContent.length, taken);
    label.style.left = `${left}px`;
    label.style.top = `${top}px`;
  });
}

/** Of a number beside a touch: above to the right, or where no other number is. */
function freePlace(x, y, digits, taken) {
  const width = 8 * digits + 2, height = 13;  // of a label's font, in pixels
  const right = x + 6, left = x - 6 - width, above = y - 19, below = y + 6;
  const isFree = ([at, top]) => taken.every((other) => other.at + other.width < at || at + width < other.at || Math.abs(other.top - top) > height);
  const places = [[right, above], [right, below], [left, above], [left, below]];
  const [at, top] = places.find(isFree) || places[0];
  taken.push({at, top, width});
  return [at, top];
}

let waiting = false;
/** With the next frame; the page is ready once the first is there. */
function draw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    for (const material of lineMaterials) material.resolution.set(canvas.clientWidth, canvas.clientHeight);
    renderer.render(scene, camera);
    drawScaleBar();
    drawLabels();
    document.documentElement.dataset.ready = 'yes';
  });
}

// ---- states: after each batch, and in the end

let now = run.states.length - 1;
let shownField = 'mean';

function valuesOf(state, name) {
  return state.isFinal ? finals[name] : state.fields[name] ? field(state.fields[name]) : null;
}

function paint() {
  const state = run.states[now];
  const values = valuesOf(state, shownField);
  const value = geometry.getAttribute('value');
  value.array.set(values || still);
  value.needsUpdate = true;
  const [low, high] = run.limits[shownField];
  Object.assign(tissueMaterial.uniforms.low, {value: low});
  Object.assign(tissueMaterial.uniforms.high, {value: high});
  tissueMaterial.uniforms.palette.value = textures[shownField];
  drawColourBar(low, high, Boolean(values));
}

function drawColourBar(low, high, known) {
  const stops = PALETTES[shownField].map((colour) => `rgb(${colour.join(',')})`).join(',');
  byId('colours').style.background = known ? `linear-gradient(to right, ${stops})` : '#eee';
  const unit = shownField === 'probability_inside' ? '' : run.unit ? ` ${run.unit}` : '';
  byId('colour-low').textContent = `${shownField === 'stddev' || shownField === 'probability_inside' ? '' : '\u2264 '}${number(low, 3)}`;
  byId('colour-high').textContent = `${shownField === 'probability_inside' ? '' : '\u2265 '}${number(high, 3)}${unit}`;
  byId('colour-middle').textContent = !known ? 'not known yet' : shownField === 'mean' && run.level !== null ? `level ${number(run.level, 3)}` : '';
}

function showState(index) {
  now = index;
  const state = run.states[now];
  byId('batch').value = String(now);
  byId('batch').setAttribute('aria-valuetext', state.name);
  const felt = shownTouches().filter((touch) => touch.kind === KIND.stop || touch.kind === KIND.way).length;
  byId('batch-words').textContent = touches.length ? `${state.name}: ${felt} readings` : state.name;
  free(outlineThen);
  outlineThen = !state.isFinal && state.outline ? lineOf(places(state.outline), LINES.estimate) : [];
  free(tourNow);
  tourNow = [];
  const tour = run.tours[String(state.batch)];
  if (tour) tourNow = lineOf(places(tour), {colour: 0x5a5a5a, width: 1.2, dash: 0.006});
  paint();
  showLines();
  drawDots();
  draw();
}

function showLines() {
  const isFinal = Boolean(run.states[now].isFinal), isLast = Boolean(run.states[now].isLast), isOn = (id) => byId(id).checked;
  const set = (parts, on) => (parts || []).forEach((part) => { part.visible = on; });
  set(lines.estimate, isFinal && isOn('show-boundary'));
  set(outlineThen, isOn('show-boundary'));
  set(lines.truth, isOn('show-truth'));
  set(lines.cut, isFinal && isOn('show-cut'));
  set(lines.band_inner, isFinal && isOn('show-band'));
  set(lines.band_outer, isFinal && isOn('show-band'));
  set(tourNow, isOn('show-tour'));
  tissueMaterial.uniforms.showBand.value = isFinal && isOn('show-band') && run.bandScore !== null;
  tissueMaterial.uniforms.showUnsearched.value = isOn('show-unsearched') && isLast;
  tissueMaterial.uniforms.shade.value = isOn('show-shape');
}

// ---- asking

const ray = new T.Raycaster();

function rowOf(touch) { return touch.kind === KIND.next ? null : byId(`reading-${touch.n}`); }

function choose(touch, fromTable) {
  for (const row of document.querySelectorAll('tr.chosen')) row.classList.remove('chosen');
  chosen = touch;
  if (touch) {
    const row = rowOf(touch);
    if (row) row.classList.add('chosen');
    if (fromTable && touch.batch > run.states[now].batch) return showState(run.states.length - 1), tell(touch);
    tell(touch);
  }
  drawDots();
  draw();
}

function tell(touch) {
  const row = rowOf(touch), picked = byId('picked');
  const words = [touch.kind === KIND.next ? `Next stop ${touch.n}` : `Touch ${touch.n}`];
  if (row) words.push(...['data-reading', 'data-why'].map((name) => row.getAttribute(name)).filter(Boolean));
  words.push(`at (${[touch.place.x, touch.place.y, touch.place.z].map((one) => number(one, 5)).join(', ')}) mm`);
  picked.textContent = words.join(', ');
  picked.dataset.touch = touch.n;
  delete picked.dataset.vertex;
}

function tellVertex(vertex) {
  const state = run.states[now], picked = byId('picked'), unit = run.unit ? ` ${run.unit}` : '', words = [];
  for (const [name, title] of [['mean', 'stiffness'], ['stddev', '\u00b1'], ['probability_inside', 'probability of tumour']]) {
    const values = valuesOf(state, name);
    if (!values) continue;
    words.push(`${title} ${number(values[vertex], state.isFinal ? 6 : 3)}${name === 'probability_inside' ? '' : unit}`);
    picked.dataset[name === 'probability_inside' ? 'probability' : name] = values[vertex];
  }
  const place = [0, 1, 2].map((i) => number(position[3 * vertex + i], 5));
  picked.textContent = `Vertex ${vertex} at (${place.join(', ')}) mm: ${words.join(', ')}`;
  picked.dataset.vertex = vertex;
  delete picked.dataset.touch;
}

function pick(x, y) {
  const screen = new T.Vector3(), view = camera.position.clone().sub(controls.target).normalize();
  let nearest = null, least = 12;  // pixels
  for (const touch of byId('show-touches').checked ? shownTouches() : []) {
    screen.copy(touch.place).project(camera);
    const far = Math.hypot((screen.x + 1) / 2 * canvas.clientWidth - x, (1 - screen.y) / 2 * canvas.clientHeight - y);
    if (far < least && normalAt(touch).dot(view) > 0) { least = far; nearest = touch; }
  }
  if (nearest) return choose(nearest, false);
  choose(null, false);
  ray.setFromCamera(new T.Vector2(2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight), camera);
  const [hit] = ray.intersectObject(tissue);
  if (!hit) {
    byId('picked').textContent = '';
    return;
  }
  const ends = [hit.face.a, hit.face.b, hit.face.c], place = new T.Vector3();
  const distance = (vertex) => place.fromArray(position, 3 * vertex).distanceToSquared(hit.point);
  tellVertex(ends.reduce((best, vertex) => (distance(vertex) < distance(best) ? vertex : best)));
}

let pressed = null;
canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY]; });
canvas.addEventListener('pointerup', (event) => {
  if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 5) return;
  const box = canvas.getBoundingClientRect();
  pick(event.clientX - box.left, event.clientY - box.top);
});

/** Turns the camera about the target: about what is up, and about what is right. */
function turn(aboutUp, aboutRight) {
  const arm = camera.position.clone().sub(controls.target);
  const across = camera.up.clone().cross(arm).normalize();
  arm.applyAxisAngle(camera.up, aboutUp);
  const tilted = arm.clone().applyAxisAngle(across, aboutRight);
  if (tilted.angleTo(camera.up) > 0.05 && tilted.angleTo(camera.up) < Math.PI - 0.05) arm.copy(tilted);
  camera.position.copy(controls.target).add(arm);
  camera.lookAt(controls.target);
  controls.update();
  draw();
}

function zoom(by) {
  camera.zoom = Math.min(Math.max(camera.zoom * by, 0.2), 60);
  camera.updateProjectionMatrix();
  draw();
}

const KEYS = {
  ArrowLeft: () => turn(0.12, 0), ArrowRight: () => turn(-0.12, 0), ArrowUp: () => turn(0, 0.12), ArrowDown: () => turn(0, -0.12),
  '+': () => zoom(1.25), '=': () => zoom(1.25), '-': () => zoom(0.8), '0': resetView,
  '[': () => showState(Math.max(now - 1, 0)), ']': () => showState(Math.min(now + 1, run.states.length - 1)),
};
canvas.addEventListener('keydown', (event) => {
  const act = KEYS[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act();
});

// ---- controls

for (const radio of document.querySelectorAll('input[name=field]')) {
  radio.addEventListener('change', () => {
    shownField = radio.value;
    paint();
    draw();
  });
}
for (const box of document.querySelectorAll('.viewer input[type=checkbox]')) {
  box.addEventListener('change', () => {
    showLines();
    drawDots();
    draw();
  });
}
byId('batch').max = String(run.states.length - 1);
byId('batch').addEventListener('input', (event) => showState(Number(event.target.value)));
byId('reset').addEventListener('click', resetView);
byId('closer').addEventListener('click', () => zoom(1.25));
byId('farther').addEventListener('click', () => zoom(0.8));
controls.addEventListener('change', draw);
for (const button of document.querySelectorAll('button.show-touch')) {
  button.disabled = false;
  button.addEventListener('click', () => {
    choose(touches.find((touch) => touch.kind !== KIND.next && touch.n === Number(button.textContent)), true);
    byId('tissue').scrollIntoView({block: 'nearest'});
  });
}
new ResizeObserver(() => {
  const zoomed = camera.zoom;
  fit();
  camera.zoom = zoomed;
  camera.updateProjectionMatrix();
  draw();
}).observe(canvas.parentElement);

resetView();
showState(run.states.length - 1);
})();
