// What is drawn: map, scan, path and machine.
import { kColourModes, MapClouds, pointCloud, pointMaterial } from "./map.js";

const kMostPath = 1 << 17;
// Time to draw a frame, in ms: while a finger moves the picture there are 30 a second, else a scan is drawn in time.
const kTouchedFrame = 22, kFrame = 60;
const kRest = 400;  // ms without a change, after which all points are drawn
const kFewest = 40000, kSmoothing = 0.2;
const kHealthColours = ["#555555", "#c800c8", "#ff9500", "#e00000"];  // of enum Health
const kPathBreak = 255;

/** Only what is new goes to the graphics memory. */
function markNew(attribute, begin, end) {
  const range = attribute.updateRange, from = begin * attribute.itemSize, to = end * attribute.itemSize;
  const first = range.count > 0 ? Math.min(range.offset, from) : from;
  const last = range.count > 0 ? Math.max(range.offset + range.count, to) : to;
  attribute.updateRange = { offset: first, count: last - first };
  attribute.needsUpdate = true;
}

function machine() {
  const body = new THREE.Group();
  const box = new THREE.Mesh(new THREE.BoxGeometry(3, 1.6, 1), new THREE.MeshBasicMaterial({ color: "#cc0033" }));
  const nose = new THREE.Mesh(new THREE.ConeGeometry(1, 2, 4), new THREE.MeshBasicMaterial({ color: "#ff3366" }));
  nose.rotation.z = -Math.PI / 2;
  nose.position.x = 2.5;
  body.add(box, nose, new THREE.AxesHelper(3));
  return body;
}

function pathPoints() {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * kMostPath), 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * kMostPath), 3));
  geometry.setDrawRange(0, 0);
  const material = new THREE.PointsMaterial({ size: 5, sizeAttenuation: false, vertexColors: THREE.VertexColors });
  const path = new THREE.Points(geometry, material);
  path.frustumCulled = false;
  return path;
}

const yawOf = (q) => Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));

/** How many points can be drawn in time, by how long it took for those before. */
class Pace {
  constructor(canvas) {
    this.per_point = 1e-4;  // ms
    this.touched = -Infinity;
    const touch = (event) => { if (event.buttons !== 0 || event.type === "wheel") this.touched = performance.now(); };
    for (const kind of ["mousemove", "touchmove", "wheel"]) canvas.addEventListener(kind, touch, { passive: true });
  }

  points(now) {
    return Math.max(kFewest, (now - this.touched < kRest ? kTouchedFrame : kFrame) / this.per_point);
  }

  measure(points, draw) {
    const begin = performance.now();
    draw();
    const taken = (performance.now() - begin) / Math.max(points, 1);
    this.per_point += (taken - this.per_point) * kSmoothing;
  }
}

/** A sink for stream.js. */
export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(60, 1, 0.5, 5000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.minDistance = 2;
    this.controls.maxDistance = 1500;  // m
    this.controls.addEventListener("change", () => { this.changed = true; });
    this.clouds = new MapClouds();
    this.now_material = pointMaterial(3, "lidar");
    this.track = pathPoints();
    this.body = machine();
    this.scene.add(this.clouds, this.track, this.body);
    this.pace = new Pace(canvas);
    this.frames = 0;
    this.begin();
    this.draw();
  }

  begin() {
    this.map_epoch = this.path_epoch = 0;
  }

  setTheme(theme) {
    this.scene.background = new THREE.Color(theme === "dark" ? "#000000" : "#ffffff");
    this.clouds.setTheme(theme);
    this.changed = true;
  }

  setColour(mode) {
    this.clouds.material.uniforms.mode.value = kColourModes.indexOf(mode);
    this.changed = true;
  }

  setCamera(mode) {
    this.mode = mode;
    const at = this.body.position, yaw = yawOf(this.body.quaternion);
    this.controls.target.copy(at);
    if (mode === "top") this.camera.position.set(at.x, at.y - 0.01, at.z + 70);
    else this.camera.position.set(at.x - 22 * Math.cos(yaw), at.y - 22 * Math.sin(yaw), at.z + 14);
    this.controls.enableRotate = mode !== "top";
    this.controls.update();
    this.changed = true;
  }

  map(epoch, origin, points) {
    if (epoch !== this.map_epoch) this.clouds.clear();
    this.map_epoch = epoch;
    this.clouds.append(points, origin);
    this.changed = true;
  }

  scan(origin, quaternion, points) {
    if (this.now) { this.scene.remove(this.now); this.now.geometry.dispose(); }
    this.now = pointCloud(points, origin, this.now_material);
    this.scene.add(this.now);
    this.moveTo(new THREE.Vector3(...origin), new THREE.Quaternion(...quaternion));
    this.changed = true;
  }

  path(epoch, points) {
    const geometry = this.track.geometry, { position, color } = geometry.attributes;
    if (epoch !== this.path_epoch) geometry.setDrawRange(0, 0);
    this.path_epoch = epoch;
    const begin = geometry.drawRange.count;
    let end = begin;
    for (let i = 0; i < points.count && end < position.count; ++i) {
      if (points.health[i] === kPathBreak) continue;
      position.array.set(points.positions.subarray(3 * i, 3 * i + 3), 3 * end);
      new THREE.Color(kHealthColours[points.health[i]]).toArray(color.array, 3 * end);
      ++end;
    }
    for (const attribute of [position, color]) markNew(attribute, begin, end);
    geometry.setDrawRange(0, end);
    this.changed = true;
  }

  /** The camera keeps its place beside the machine, and in follow also its side of it. */
  moveTo(position, quaternion) {
    const step = position.clone().sub(this.body.position);
    const turn = yawOf(quaternion) - yawOf(this.body.quaternion);
    this.body.position.copy(position);
    this.body.quaternion.copy(quaternion);
    if (this.mode === "orbit") return;
    this.controls.target.add(step);
    this.camera.position.add(step);
    if (this.mode === "follow")
      this.camera.position.sub(position).applyAxisAngle(this.camera.up, turn).add(position);
    this.controls.update();
  }

  fit() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (this.width === width && this.height === height) return;
    this.width = width;
    this.height = height;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.changed = true;
  }

  draw() {
    requestAnimationFrame(() => this.draw());
    this.fit();
    const now = performance.now();
    if (this.changed) this.moved = now;
    const rests = now - this.moved > kRest;
    if (!this.changed && !(rests && this.thinned)) return;
    this.changed = false;
    this.clouds.measureHeights();
    this.camera.updateMatrixWorld();
    this.thinned = this.clouds.thin(this.camera, rests ? Infinity : this.pace.points(now));
    this.pace.measure(this.clouds.drawn, () => this.renderAndWait());
    for (const attribute of Object.values(this.track.geometry.attributes))
      attribute.updateRange = { offset: 0, count: -1 };
    // For whoever measures: how often was drawn, and how much.
    const { points, drawn } = this.clouds;
    Object.assign(document.body.dataset, { frames: ++this.frames, points, drawn });
  }

  renderAndWait() {
    this.renderer.render(this.scene, this.camera);
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // comes when the picture is done
  }
}
