// A site that `scanloom site` wrote: its tiles, drives, loops, references, and what is gone.
import { connectChoice, connectTheme } from "./choice.js";
import { kLidarColours, MapClouds } from "./map.js";

const element = (id) => document.getElementById(id);
const kMostPoints = 3e6;  // drawn at once
const kColours = { accepted: "#00a651", refused: "#e00000", used: "#0a7cff", unused: "#ff7a00", gone: "#d400c8" };

async function text(path) {
  const answer = await fetch(path);
  return answer.ok ? answer.text() : "";
}

/** Rows of a table by the names of its columns; a field with a comma is quoted. */
function rowsOf(csv) {
  const [head, ...lines] = csv.split("\n").filter((line) => line !== "");
  const fields = (line) => [...line.matchAll(/("([^"]|"")*"|[^,]*)(,|$)/g)].map(([, field]) =>
    field.startsWith('"') ? field.slice(1, -1).replaceAll('""', '"') : field);
  const names = head ? fields(head) : [];
  return lines.map((line) => Object.fromEntries(fields(line).map((field, i) => [names[i], field])));
}

/** [stamp in s as text, x, y, z] */
function posesOf(tum, origin) {
  return tum.split("\n").filter((line) => line && line[0] !== "#").map((line) => {
    const [stamp, x, y, z] = line.split(" ");
    return [stamp, x - origin[0], y - origin[1], z - origin[2]];
  });
}

/** Of the pose at the stamp (ns), which a keyframe shares to the nanosecond; else of the nearest. */
function placeAt(poses, stamp_ns) {
  const wanted = Number(stamp_ns) * 1e-9;
  let low = 0, high = poses.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (Number(poses[middle][0]) < wanted) low = middle + 1; else high = middle;
  }
  if (low > 0 && wanted - Number(poses[low - 1][0]) < Number(poses[low][0]) - wanted) --low;
  return poses[low].slice(1);
}

/** Crowns hide nothing of it: drawn last, over the tiles. */
function drawn(kind, places, material) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places.flat()), 3));
  const object = new kind(geometry, material);
  object.renderOrder = 1;
  return object;
}

const lines = (ends, color, kind = THREE.LineSegments) =>
  drawn(kind, ends, new THREE.LineBasicMaterial({ color, depthTest: false, transparent: true }));
const dots = (places, color) =>
  drawn(THREE.Points, places,
        new THREE.PointsMaterial({ color, size: 6, sizeAttenuation: false, depthTest: false, transparent: true }));

function addTerm(list, name, value, colour) {
  const term = document.createElement("dt"), definition = document.createElement("dd");
  term.textContent = name;
  definition.textContent = value;
  if (colour) term.style.borderLeft = `.6rem solid ${colour}`, term.style.paddingLeft = ".4rem";
  element(list).append(term, definition);
}

class SiteScene {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(60, 1, 0.5, 20000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => { this.changed = true; });
    this.clouds = new MapClouds();
    this.box = new THREE.Box3();
    this.layers = {};
    this.add("tiles", this.clouds);
    this.draw();
  }

  add(layer, object) {
    if (!this.layers[layer]) this.addLayer(layer);
    this.layers[layer].add(object);
    if (object.geometry) {
      object.geometry.computeBoundingBox();
      this.box.union(object.geometry.boundingBox);
    }
    this.changed = true;
  }

  addLayer(layer) {
    const group = this.layers[layer] = new THREE.Group(), button = document.createElement("button");
    this.scene.add(group);
    button.textContent = layer;
    button.setAttribute("aria-pressed", "true");
    button.onclick = () => {
      group.visible = !group.visible;
      button.setAttribute("aria-pressed", String(group.visible));
      this.changed = true;
    };
    element("layers").append(button);
  }

  setTheme(theme) {
    this.scene.background = new THREE.Color(theme === "dark" ? "#000000" : "#ffffff");
    this.clouds.setTheme(theme);
    this.changed = true;
  }

  /** All drives are seen. */
  setCamera(mode) {
    this.mode = mode;
    const middle = this.box.getCenter(new THREE.Vector3()), size = this.box.getSize(new THREE.Vector3());
    const away = Math.max(size.x, size.y, 20);
    this.controls.target.copy(middle);
    if (mode === "top") this.camera.position.set(middle.x, middle.y - 0.01, middle.z + away);
    else this.camera.position.set(middle.x - 0.5 * away, middle.y - 0.7 * away, middle.z + 0.5 * away);
    this.controls.enableRotate = mode !== "top";
    this.controls.update();
    this.changed = true;
  }

  fit() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (this.width === width && this.height === height) return;
    Object.assign(this, { width, height, changed: true });
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  draw() {
    requestAnimationFrame(() => this.draw());
    this.fit();
    if (!this.changed) return;
    this.changed = false;
    this.clouds.measureHeights();
    this.camera.updateMatrixWorld();
    this.clouds.thin(this.camera, kMostPoints);
    this.renderer.render(this.scene, this.camera);
  }
}

/** Drawing a part of the points needs them in random order. */
function shuffled(cm) {
  for (let i = cm.length / 3 - 1; i > 0; --i) {
    const k = Math.floor(Math.random() * (i + 1));
    for (let axis = 0; axis < 3; ++axis)
      [cm[3 * i + axis], cm[3 * k + axis]] = [cm[3 * k + axis], cm[3 * i + axis]];
  }
  return cm;
}

async function showTiles(scene, site) {
  for (let number = 0; number < site.tiles.length; ++number) {
    const bytes = await (await fetch(`tile?number=${number}`)).arrayBuffer();
    const cm = shuffled(new Int16Array(bytes.slice(24))), count = cm.length / 3;
    scene.clouds.append({ count, cm, reflectivity: new Uint8Array(count), lidar: new Uint8Array(count) },
                        [...new Float64Array(bytes.slice(0, 24))]);
    scene.changed = true;
  }
}

async function showDrives(scene, site) {
  const drives = {};
  for (let number = 0; number < site.drives.length; ++number) {
    const { name, pieces } = site.drives[number];
    const poses = drives[name] = posesOf(await text(`drive?number=${number}`), site.coordinates_less);
    const colour = kLidarColours[number % kLidarColours.length], others = pieces.filter(({ piece }) => piece !== 1);
    for (const { begin_ns, end_ns } of pieces.filter(({ piece }) => piece === 1)) {
      const within = poses.filter(([stamp]) => stamp >= begin_ns * 1e-9 && stamp <= end_ns * 1e-9);
      scene.add("drives", lines(within.map((pose) => pose.slice(1)), colour, THREE.Line));
    }
    addTerm("drives", name, others.length === 0 ? `${poses.length} poses` :
            `not in this map: piece ${others.map(({ piece }) => piece).join(", ")}`, colour);
  }
  return drives;
}

function showLoops(scene, loops, drives, shown) {
  const counts = {};
  const ends = { accepted: [], refused: [] };
  for (const loop of loops) {
    counts[loop.decision] = (counts[loop.decision] || 0) + 1;
    if (!shown(loop.from_drive) || !shown(loop.to_drive)) continue;
    ends[loop.decision === "accepted" ? "accepted" : "refused"].push(
      placeAt(drives[loop.from_drive], loop.from_stamp_ns), placeAt(drives[loop.to_drive], loop.to_stamp_ns));
  }
  scene.add("loops", lines(ends.accepted, kColours.accepted));
  scene.add("refused loops", lines(ends.refused, kColours.refused));
  for (const [decision, count] of Object.entries(counts))
    addTerm("loops", decision, count, decision === "accepted" ? kColours.accepted : kColours.refused);
}

function showReferences(scene, references, origin) {
  if (references.length === 0) return;
  element("with_references").hidden = false;
  const place = (row) => [row.x - origin[0], row.y - origin[1], row.z - origin[2]];
  const residual = (row) => [Number(row.residual_x), Number(row.residual_y), Number(row.residual_z)];
  const used = references.filter((row) => row.used === "1"), unused = references.filter((row) => row.used !== "1");
  scene.add("references", dots(used.map(place), kColours.used));
  scene.add("references", dots(unused.map(place), kColours.unused));
  scene.add("references", lines(references.flatMap((row) =>
    [place(row), place(row).map((value, axis) => value + residual(row)[axis])]), kColours.unused));
  const off = used.map((row) => Math.hypot(...residual(row)));
  const rms = Math.sqrt(off.reduce((sum, value) => sum + value * value, 0) / Math.max(off.length, 1));
  addTerm("references", "used", used.length, kColours.used);
  addTerm("references", "not used", unused.length, kColours.unused);
  addTerm("references", "off, root mean square", `${rms.toFixed(3)} m`);
  addTerm("references", "off, largest", `${Math.max(0, ...off).toFixed(3)} m`);
}

function showGone(scene, gone, origin) {
  if (gone.length === 0) return;
  element("with_gone").hidden = false;
  const foot = (row) => [row.x - origin[0], row.y - origin[1], row.z - origin[2]];
  scene.add("gone", lines(gone.flatMap((row) => {
    const [x, y, z] = foot(row);
    return [[x, y, z], [x, y, z + Number(row.height)]];
  }), kColours.gone));
  scene.add("gone", dots(gone.map(foot), kColours.gone));
  for (const row of gone) {
    const item = document.createElement("li");
    item.textContent = `${row.height} m high at ${row.x}, ${row.y}: ${row.gone_by} saw through it`;
    element("gone").append(item);
  }
}

function showWord(word, why) {
  element("health").dataset.word = word;
  element("word").textContent = word;
  element("why").textContent = why;
}

async function showAll(scene) {
  const site = JSON.parse(await text("site.json"));
  const inMap = new Set(site.drives.filter(({ pieces }) => pieces.some(({ piece }) => piece === 1))
    .map(({ name }) => name));
  const drives = await showDrives(scene, site);
  showLoops(scene, rowsOf(await text("loops.csv")), drives, (name) => inMap.has(name));
  showReferences(scene, rowsOf(await text("references.csv")), site.coordinates_less);
  showGone(scene, rowsOf(await text("gone.csv")), site.coordinates_less);
  scene.setCamera(scene.mode);
  await showTiles(scene, site);
  const whole = site.pieces.length === 1;
  showWord(whole ? "OK" : "PIECES", whole ? `${site.tiles.length} tiles` :
           `${site.pieces.length} pieces that have no place in common: the largest is shown`);
}

const scene = new SiteScene(element("canvas"));
connectTheme((theme) => scene.setTheme(theme));
connectChoice("camera", "top", (mode) => scene.setCamera(mode));
showAll(scene).catch((error) => showWord("FAILED", error.message));
