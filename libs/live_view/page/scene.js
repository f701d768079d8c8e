// What is drawn: map, scan, path and machine.
import { metres } from "./stream.js";

export const kLidarColours = ["#0a7cff", "#ff7a00", "#00a651", "#d400c8", "#00b3b3", "#b58900", "#7f5fff", "#e0004d"];
const kMostPoints = 1 << 20, kMostScanPoints = 1 << 14, kMostPath = 1 << 17;
const kHealthColours = ["#555555", "#c800c8", "#ff9500", "#e00000"];  // of enum Health
const kPathBreak = 255;

const kVertex = `
  uniform int mode; uniform float low, high, size, shade; uniform vec3 colours[8];
  attribute float reflectivity, lidar;
  varying vec3 colour;
  vec3 ramp(float s) {  // blue, green, yellow, red
    return clamp(vec3(1.5 - abs(4.0 * s - 3.3), 1.4 - abs(4.0 * s - 2.0), 1.5 - abs(4.0 * s - 0.7)), 0.0, 1.0);
  }
  void main() {
    vec4 in_world = modelMatrix * vec4(position, 1.0);
    if (mode == 2) { for (int i = 0; i < 8; ++i) if (float(i) == mod(lidar, 8.0)) colour = colours[i]; }
    else {
      float s = mode == 0 ? (in_world.z - low) / max(high - low, 0.5) : sqrt(reflectivity);
      colour = shade * ramp(clamp(s, 0.0, 1.0));
    }
    gl_Position = projectionMatrix * viewMatrix * in_world;
    gl_PointSize = size;
  }`;
const kFragment = "varying vec3 colour; void main() { gl_FragColor = vec4(colour, 1.0); }";

function pointCloud(most, size) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * most), 3));
  geometry.setAttribute("reflectivity", new THREE.BufferAttribute(new Uint8Array(most), 1, true));
  geometry.setAttribute("lidar", new THREE.BufferAttribute(new Uint8Array(most), 1));
  geometry.setDrawRange(0, 0);
  const material = new THREE.ShaderMaterial({
    uniforms: { mode: { value: 0 }, low: { value: 0 }, high: { value: 10 }, size: { value: size }, shade: { value: 1 },
                colours: { value: kLidarColours.map((colour) => new THREE.Color(colour)) } },
    vertexShader: kVertex, fragmentShader: kFragment });
  const points = new THREE.Points(geometry, material);
  points.frustumCulled = false;
  return points;
}

/** Only what is new goes to the graphics memory. */
function markNew(attribute, begin, end) {
  const range = attribute.updateRange, from = begin * attribute.itemSize, to = end * attribute.itemSize;
  const first = range.count > 0 ? Math.min(range.offset, from) : from;
  const last = range.count > 0 ? Math.max(range.offset + range.count, to) : to;
  attribute.updateRange = { offset: first, count: last - first };
  attribute.needsUpdate = true;
}

function append(cloud, points, origin) {
  const { position, reflectivity, lidar } = cloud.geometry.attributes;
  const begin = cloud.geometry.drawRange.count, end = Math.min(begin + points.count, position.count);
  for (let i = begin, j = 0; i < end; ++i, ++j) {
    for (let k = 0; k < 3; ++k) position.array[3 * i + k] = origin[k] + metres(points, j, k);
    reflectivity.array[i] = points.reflectivity[j];
    lidar.array[i] = points.lidar[j];
  }
  for (const attribute of [position, reflectivity, lidar]) markNew(attribute, begin, end);
  cloud.geometry.setDrawRange(0, end);
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

/** A sink for stream.js. */
export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(60, 1, 0.5, 5000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => { this.changed = true; });
    this.cloud = pointCloud(kMostPoints, 2);
    this.now = pointCloud(kMostScanPoints, 3);
    this.now.material.uniforms.mode.value = 2;
    this.track = pathPoints();
    this.body = machine();
    this.scene.add(this.cloud, this.now, this.track, this.body);
    this.frames = 0;
    this.begin();
    this.draw();
  }

  begin() {
    this.map_epoch = this.path_epoch = 0;
  }

  setTheme(theme) {
    this.scene.background = new THREE.Color(theme === "dark" ? "#000000" : "#ffffff");
    this.cloud.material.uniforms.shade.value = theme === "dark" ? 1 : 0.72;
    this.changed = true;
  }

  setColour(mode) {
    this.cloud.material.uniforms.mode.value = ["height", "reflectivity", "lidar"].indexOf(mode);
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
    if (epoch !== this.map_epoch) this.cloud.geometry.setDrawRange(0, 0);
    this.map_epoch = epoch;
    append(this.cloud, points, origin);
    this.heights_old = true;
    this.changed = true;
  }

  scan(origin, quaternion, points) {
    this.now.geometry.setDrawRange(0, 0);
    append(this.now, points, [0, 0, 0]);
    this.now.position.set(...origin);
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

  /** Most of the points have a colour of their own: a few very high ones do not make all others alike. */
  measureHeights() {
    const count = this.cloud.geometry.drawRange.count, heights = [];
    const step = Math.max(1, Math.floor(count / 2000));
    for (let i = 0; i < count; i += step) heights.push(this.cloud.geometry.attributes.position.array[3 * i + 2]);
    heights.sort((a, b) => a - b);
    if (heights.length === 0) return;
    this.cloud.material.uniforms.low.value = heights[Math.floor(0.02 * (heights.length - 1))];
    this.cloud.material.uniforms.high.value = heights[Math.floor(0.98 * (heights.length - 1))];
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
    if (!this.changed) return;
    this.changed = false;
    if (this.heights_old) this.measureHeights();
    this.heights_old = false;
    this.renderer.render(this.scene, this.camera);
    for (const cloud of [this.cloud, this.now, this.track])
      for (const attribute of Object.values(cloud.geometry.attributes)) attribute.updateRange = { offset: 0, count: -1 };
    // For whoever measures: how often was drawn, and how much.
    document.body.dataset.frames = ++this.frames;
    document.body.dataset.points = this.cloud.geometry.drawRange.count;
  }
}
